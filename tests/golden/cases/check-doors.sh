# Ways past the proof: what a proxy or a scene holds and does not show at first sight. Exit status 0 is for what was proven.
cp "$BP_ROOT"/tests/data/bugs/hash_collision.obj .
write_cube cube.obj 1
sed 's/^v \(.*\) \(.*\) \(.*\)$/echo v $((\1 * 3 - 1)) $((\2 * 3 - 1)) $((\3 * 3 - 1))/e' cube.obj > around.obj  # -1 to 2
awk '/^v/ { print "v", $2 / 2 + .25, $3 / 2 + .25, $4 / 2 + .25; next } { print }' cube.obj > within.obj
last() { said "$1 | tail -1"; }

# An export that failed, among several scenes: each tool refuses it by its name.
echo "# nothing" > empty.obj
try bpcheck cube.obj empty.obj around.obj
try bpvox empty.obj cube.obj --resolution 16 -o o.bpv
try bplod cube.obj empty.obj --resolution 16 -q -o o
bplod cube.obj --resolution 16 --levels 1 --faces 12 --profile 3dtiles -q -o tiles > list
try bpcheck empty.obj tiles/tileset.json

# What is left out of a scene has no place, and might stick out.
{ cat cube.obj; printf 'v nan 0 0\nv 999 0 0\nf 9 10 1\nf 1 2 99\n'; } > broken.obj
said 'bpcheck broken.obj around.obj | grep -E "left out|encloses|decided"'
last 'bpcheck --inside broken.obj within.obj'
said 'bpcheck broken.obj tiles/tileset.json'
said 'bpcheck broken.obj tiles/tileset.json --json | grep -A3 skipped'
rm -r tiles list

# Faces of a proxy that name nothing: one program drops them, another draws them.
for face in 'f 1 2 999' 'f 0 1 2' 'f 1 2' surf; do
  { cat around.obj; echo "$face"; } > faces.obj
  last 'bpcheck cube.obj faces.obj'
done

# Quads that are not flat are drawn over either diagonal.
{ grep '^v' cube.obj | sed 's/^v 1 1 1/v 1 1 1.5/'; grep ^f cube.obj; } > bent.obj
said 'bpcheck bent.obj around.obj | grep -E "flat|hold"'

# A triangle without area is a segment, or a point: it is enclosed as such, and a proxy that it leaves is refuted.
{ cat cube.obj; printf 'v .5 .5 .5\nv .5 .5 6\nf 9 10 9\nv 3 3 3\nf 11 11 11\n'; } > spike.obj
said 'bpcheck spike.obj around.obj | grep -E "area|encloses|lies|touch|hold"'
bpvox spike.obj --resolution 32 | bpclose --scale 2vx | bpmesh --faces 100 -q -o spike.ply
last 'bpcheck spike.obj spike.ply'
bplod spike.obj --resolution 32 -q --levels 2 -o lod > list
for level in lod/*.glb; do last "bpcheck spike.obj $level"; done
bplod spike.obj --resolution 32 --tile 64 --profile 3dtiles --leaves scene -q -o tiles > list
last 'bpcheck spike.obj tiles/tileset.json'
rm -r lod tiles list

# An open box, and 128 loose triangles that made the sum of an earlier version's hashes zero.
last 'bpcheck --inside hash_collision.obj within.obj'

# Hulls far from the origin: their own command decides.
printf 'OFF\n3 1 0\n4199999.215797944 170000.3066335489 4779999.820826206\n4200000.934885023 170000.9755333692 4779999.9098891225\n4199999.215826404 170000.30665537406 4779999.82086229\n3 0 1 2\n' > far.off
bplod far.off --profile collision --resolution 32 --hulls 3 --name far -q -o hulls > list
last 'bpcheck --convex far.off hulls/far_unreal.glb'
rm -r hulls list

# Levels inside one another: the vertices of the second are not in the voxels that its file names. The slit is a millimetre.
write_ball ball.obj 2
awk '/^v/ { n++; v[n] = $0 } /^f/ && !done { split(v[$3], p, " "); print "v", p[2], p[3], p[4] + .001; $3 = n + 1; done = 1 } { print }' ball.obj > slit.obj
bpvox slit.obj --resolution 64 --fill inside -q | bpclose -q --element ball --scale 10% | bpmesh -q --faces 80,20 -o in.ply
for level in 0 1; do said "bpcheck --inside slit.obj in.$level.ply | grep -E 'hidden|hold|decided'"; done
said 'bpcheck --inside slit.obj in.0.ply --json | grep -A4 "\"hidden\": {"'

# Two millimetres at a million: leaves lie in the boxes of their tiles.
awk '/^v/ { printf "v %.17g %.17g %.17g\n", 1e6 + $2 / 1000, 1e6 + $3 / 1000, 5e5 + $4 / 1000; next } { print }' ball.obj > tiny.obj
bplod tiny.obj --profile 3dtiles --resolution 66 --tile 64 --leaves scene -q -o tiles > list
last 'bpcheck tiny.obj tiles/tileset.json'
# Lines of OBJ that other programs read as faces, or from elsewhere; a node whose place programs disagree on.
cp "$BP_ROOT"/tests/data/bugs/fo_call.obj "$BP_ROOT"/tests/data/bugs/matrix_and_trs.gltf .
write_cube around.obj 3
sed -i '/^v/ s/ 0/ -1/g' around.obj
sed '/^fo/d' fo_call.obj > call.obj
sed '/^call/d; /^bsp/d' fo_call.obj > fo.obj
last 'bpcheck call.obj around.obj'
last 'bpcheck fo.obj around.obj'
try bpcheck matrix_and_trs.gltf around.obj
rm fo.obj call.obj fo_call.obj matrix_and_trs.gltf

# Files that programs read in different ways, or that say more than their head promises. Each has a part 5 away, where the other reading has it.
bugs=$BP_ROOT/tests/data/bugs
cp "$bugs"/{key_twice.gltf,long_rotation.gltf,x_twice.ply,origin_of_others.gltf} .
tetrahedron() { printf 'OFF\n4 4 0\n%d 0 0\n%d 0 0\n%d 1 0\n%d 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' "$1" $(($1 + 1)) "$1" "$1"; }
{ tetrahedron 0; tetrahedron 5; } > two_shapes.off
{ echo '# origin: 5 0 0'; cat around.obj; } > origin_of_others.obj
try bpcheck key_twice.gltf around.obj
last 'bpcheck long_rotation.gltf around.obj'
try bpcheck two_shapes.off around.obj
try bpcheck x_twice.ply around.obj
# The origin of somebody else's file moves nothing.
awk '/^v/ { print "v", $2 + 5, $3, $4; next } { print }' cube.obj > away.obj
for proxy in origin_of_others.gltf origin_of_others.obj; do
  last "bpcheck cube.obj $proxy"
  last "bpcheck away.obj $proxy"
done
rm key_twice.gltf long_rotation.gltf two_shapes.off x_twice.ply origin_of_others.gltf origin_of_others.obj away.obj

# A hundred thousand arrays within each other.
{ printf '{"asset":{"version":"2.0","extras":'; head -c 100000 /dev/zero | tr '\0' '['; head -c 100000 /dev/zero | tr '\0' ']'; echo '}}'; } > deep.gltf
try bpcheck deep.gltf around.obj
try bpinfo deep.gltf
try bpcheck cube.obj deep.gltf

# Names that would be a line of the answer.
cp around.obj $'x\nholds\n.obj'
said "bpcheck around.obj $'x\\nholds\\n.obj' | grep -E '^(holds|proxy|scene)'"
said "bpcheck $'x\\nholds\\n.obj' cube.obj | grep -E '^(holds|proxy|scene)'"
try bplod $'x\nholds\n.obj' --resolution 16 -o lod
rm $'x\nholds\n.obj' deep.gltf around.obj

# Glass, and walls that viewers hide, hide nothing.
for walls in glass_room hidden_room; do
  cp "$bugs/$walls.gltf" .
  said "bplod $walls.gltf --profile occluder --resolution 32 -o occluder > list"
  rm -rf $walls.gltf occluder list
done
