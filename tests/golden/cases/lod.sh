# Levels of detail in one process. What the meshes look like may change; that they enclose, keep budgets and fit together may not.
write_cube cube.obj 3
for i in 0 1 2 3 4 5 6 7; do  # eight cubes that lie apart: 96 faces at least, unless closed together
  sed "s/^v \(.*\) \(.*\) \(.*\)$/echo v \$((\1 + 7 * ($i % 2))) \$((\2 + 7 * ($i \/ 2 % 2))) \$((\3 + 7 * ($i \/ 4)))/e" cube.obj > part$i.obj
done
budgets() { awk -F '\t' -v want="$1" 'BEGIN { split(want, n, ",") } NR > 1 { print $1, ($2 <= n[NR - 1] ? "keeps" : "breaks") " its budget, error " ($3 > last ? "rises" : "falls"); last = $3 }'; }

bplod part*.obj --name cubes --faces 200,20 --resolution 60 -q -o gltf > list
budgets 200,20 < list
for f in cubes_LOD0 cubes_LOD1 cubes; do bpcheck part*.obj gltf/$f.glb | tail -1; done
bplod part*.obj --name cubes --faces 200,20 --resolution 60 -q --up z --profile 3dtiles -o tiles -j 1 --memory 300M > list
budgets 200,20 < list
try bpcheck part*.obj tiles/tileset.json
bplod part*.obj --name cubes --faces 200,20 --resolution 60 -q --up z --profile 3dtiles -o again -j 2 > list
diff -r tiles again && echo "the same bytes"
bplod part*.obj --name cubes -q --error 5.77%,69.2% -o errors > list
awk -F '\t' 'NR > 1 { print $1, ($3 <= (NR == 2 ? 1 : 12) ? "keeps" : "breaks") " its error" }' list
bplod part*.obj --name cubes --error 50px,1.5px -q -o screen | cut -f 1

# Levels that are cut into tiles.
bplod part*.obj --name cubes --resolution 160 --tile 128 --profile 3dtiles -q -o cut -j 1 --memory 300M | cut -f 1
bpcheck part*.obj cut/tileset.json | sed 's/[0-9]* triangles/some triangles/'
bplod part*.obj --name cubes --resolution 160 --tile 128 --profile 3dtiles -q -o cut2 -j 2 > list
diff -r cut cut2 && echo "the same bytes"
said 'bplod part*.obj --name cubes --resolution 160 --tile 128 --levels 1 --faces 500 --up z --profile 3dtiles -o cut2 --overwrite | cut -f 1'
bpcheck part*.obj cut2/tileset.json | sed 's/[0-9]* triangles/some triangles/'
LC_ALL=C ls -A cut2
tiles=(cut2/cubes_LOD0/*)
rm "${tiles[0]}"
cp "${tiles[1]}" "${tiles[2]}"
bpcheck part*.obj cut2/tileset.json | sed 's/[0-9]* triangles/some triangles/; s/[0-9][0-9]* of [0-9][0-9]*/some/; s/by up to.*//'
try bplod cube.obj -o x --profile 3dtiles --tile 100
# Levels of few voxels are one mesh, however small the tiles: in tiles they would be far off for their faces.
bplod part*.obj --name cubes --resolution 160 --tile 64 --profile 3dtiles -q -o small | cut -f 1
# Thin rods that lie apart have few voxels: no tile of a level goes far from them to save faces.
awk 'BEGIN { for (a = 0; a < 3; ++a) for (i = 4; i < 120; i += 28) for (j = 4; j < 120; j += 28) {
  for (s = 0; s < 8; ++s) { p[a] = s % 2 ? 116 : 4; p[(a + 1) % 3] = i + int(s / 2) % 2 * 0.5; p[(a + 2) % 3] = j + int(s / 4) * 0.5; print "v", p[0], p[1], p[2] }
  for (f = 0; f < 6; ++f) { split(substr("135724681256347812345678" , 4 * f + 1, 4), c, ""); print "f", n + c[1], n + c[2], n + c[4], n + c[3] }
  n += 8 } }' > rods.obj
bplod rods.obj --voxel 1 --tile 64 --levels 2 --profile 3dtiles -q -o rods | awk -F '\t' 'NR == 2 { print $1, ($3 <= 11 ? "is near" : "is far: " $3) }'
bpcheck rods.obj rods/tileset.json | sed 's/[0-9]* triangles/some triangles/'

# A budget spends its faces near what they enclose: none spans a courtyard while others can go.
awk 'function box(x, y, z, w, d, h,  i) {
  for (i = 0; i < 8; ++i) print "v", x + (i % 2) * w, y + (int(i / 2) % 2) * d, z + int(i / 4) * h
  split("0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2 1 3 7 5", c)
  for (i = 1; i <= 24; i += 4) print "f", n + c[i] + 1, n + c[i + 1] + 1, n + c[i + 2] + 1, n + c[i + 3] + 1
  n += 8
}
BEGIN { for (k = 0; k < 9; ++k) {
  x = 40 * (k % 3); y = 40 * int(k / 3)
  box(x, y, 0, 30, 3, 10 + k); box(x, y + 27, 0, 30, 3, 12 + k); box(x, y, 0, 3, 30, 11 + k); box(x + 27, y, 0, 3, 30, 13 + k) } }' > courts.obj
bplod courts.obj --up z --voxel 0.5 --tile 128 --levels 1 --faces 120 --profile 3dtiles -q -o courts | awk -F '\t' 'NR == 2 { print $1, ($3 <= 4 ? "is near" : "is far: " $3) }'
rm -r courts courts.obj

# Collision: names that importers go by; the convex pieces enclose, too.
bplod part*.obj --name cubes --faces 96 --resolution 60 -q --profile collision -o collision | cut -f 1,2
cut_errors() { awk -F '\t' 'NR > 1 { print $1, ($3 == "-" ? "not measured" : $3 > 0 ? "measured" : "none"), $4 == s || NR == 2; s = $4 }'; }
bplod part*.obj --name cubes --faces 96 --resolution 60 -q --profile collision -o collision --overwrite | cut_errors
for f in godot unity unreal; do bpcheck part*.obj collision/cubes_$f.glb | tail -1; done
for f in unreal godot; do said "bpcheck --convex part*.obj collision/cubes_$f.glb | sed -n '/each part/p;\$p'"; done
# An angle is cut; as one hull it is closed, as the engine would, and that is said. Parts that are too many have hulls together.
printf '%s\n' v\ {0,4}\ {0,1}\ {0,1} v\ {0,1}\ {1,4}\ {0,1} > angle.obj
for i in 0 8; do
  for f in '1 2 4 3' '5 7 8 6' '1 5 6 2' '3 4 8 7' '1 3 7 5' '2 6 8 4'; do echo "f $(for v in $f; do echo -n "$((v + i)) "; done)"; done
done >> angle.obj
volumes() { sed -E 's/with [0-9.]+ times the/with SOME times the/'; }
hulls() { awk -F '[:,]' '/"hulls"/ && $2 ~ /[0-9]/ { n = $2 + 0 } /"hull_volume_over_level"/ && $2 + 0 > 0 { print (n == 1 ? "one hull" : n < 4 ? "few hulls" : n < 9 ? "some hulls" : "many hulls"), ($2 < 1.1 ? "near the level" : "far from it") }' "$1"; }
said 'bplod angle.obj --faces 40 --resolution 60 --profile collision -o angle --report angle.json | cut -f 1'
hulls angle.json
said 'bplod angle.obj --faces 40 --resolution 60 --profile collision --hulls 1 -o angle1 --report angle1.json | cut -f 1' | volumes
hulls angle1.json
for f in angle/angle_unreal angle1/angle_unreal angle/angle_godot; do said "bpcheck --convex angle.obj $f.glb | sed -n '/each part/p;\$p'"; done
# Without --convex hulls fail as one surface, and a note says how to ask.
said "bpcheck angle.obj angle/angle_unreal.glb | tail -1"
# All hulls together keep to --faces, and say what that costs.
for n in 6 12 20; do bplod angle.obj --faces $n --resolution 60 --profile collision -q -o kept --overwrite | awk -v n=$n '/unreal/ { print n, ($2 <= n ? "faces hold" : "faces are " $2) }'; done
said 'bplod angle.obj --faces 12 --resolution 60 --profile collision -o kept --overwrite | cut -f 1' | volumes
said "bpcheck --convex angle.obj kept/angle_unreal.glb | sed -n '/each part/p;\$p'"
rm -r kept
bplod angle.obj --faces 40 --resolution 60 --profile collision -q -o angle2 -j 1 > list
cmp angle/angle_unreal.glb angle2/angle_unreal.glb && echo "the same bytes"
said 'bplod part*.obj --name cubes --faces 96 --resolution 60 --profile collision --hulls 3 -o three --report three.json | cut -f 1' | volumes
hulls three.json
said "bpcheck --convex part*.obj three/cubes_unreal.glb | sed -n '/each part/p;\$p'"
try bplod cube.obj -o x --profile collision --hulls 0
try bplod cube.obj -o x --hulls 3
grep -ao '"name":"[^"]*"' collision/cubes_unreal.glb | sort -u | tr '\n' ' '
grep -ao '"name":"[^"]*"' collision/cubes_godot.glb collision/cubes_unity.glb | sort -u
bplod part*.obj --name cubes --faces 100 --mode fit --resolution 60 -q -o fit | cut -f 1
bpcheck fit/cubes_LOD0.glb | tail -1

# What is skipped of a scene is said, and counted.
sed 's/^f 1 4 3 2$/&\nv nan 0 0\nf 1 1 2\nf 1 2 9\nf 1 2 77/' cube.obj > skips.obj
try bplod skips.obj --levels 1 --resolution 24 -o skips --report skips.json > list
grep -E '"(triangles|degenerate|non_finite|bad_faces)"|skipped' skips.json

# A level that misses its faces says so, once: too few of them, as the voxels have no more, or too many.
some() { sed -E 's/part0.* part7.obj/part*.obj/; s/[0-9]+ faces instead/SOME faces instead/; s/(closed at|scale of) [0-9.]+/\1 SOME/'; }
said 'bplod part*.obj --name cubes --faces 20000,20,10 --resolution 60 -o few --report few.json > list' | some
grep -c 'faces instead of' few.json
said 'bplod part*.obj --name cubes --faces 20000 --levels 1 --resolution 60 --profile 3dtiles -o few3d > list' | some
said 'bplod part*.obj --name cubes --faces 20000 --resolution 60 --profile collision -q -o few > list'
said 'bplod cube.obj --levels 2 --resolution 24 -o few > list'  # what nobody asked for is no miss
# A budget chooses the voxels, and finer ones where it is not spent; levels that are no coarser are left out.
falls() { awk -F '\t' -v most="$1" 'NR == 2 { print ($5 < most ? "fine" : "coarse") " voxels" } NR > 2 { print $1, ($2 < faces ? "falls" : "does not fall") } { faces = $2 }'; }
said 'bplod part[01].obj --name cubes --faces 60000,20000,16 -o chosen > list' | grep -v 'a grid of' | some
falls 0.035 < list
ls chosen
bplod part[01].obj --name cubes --faces 60000 --levels 3 -q -o chosen2 > list
falls 0.035 < list
for n in 13 4; do said "bplod part*.obj --name cubes --faces $n --levels 1 --resolution 60 -o closed$n > list" | some; done
said 'bplod cube.obj --faces 12,6,5,4 --resolution 40 -o chosen3 | cut -f 1,2'
# Budgets that follow are quarters, on voxels that suffice for them; what an earlier set had more of goes.
# Voxels are halved only while a level has fewer faces than the scene has triangles: of studs that are there ten times.
studs() { awk -v n="$1" 'function box(x, y, z, w, h,  i) {
  for (i = 0; i < 8; ++i) print "v", x + (i % 2) * w, y + (int(i / 2) % 2) * w, z + int(i / 4) * h
  split("0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2 1 3 7 5", c)
  for (i = 1; i <= 24; i += 4) print "f", at + c[i] + 1, at + c[i + 1] + 1, at + c[i + 2] + 1, at + c[i + 3] + 1
  at += 8
}
BEGIN { box(0, 0, 0, 200, 4); for (k = 0; k < n; ++k) box(17 + 40 * (k % 5), 17 + 40 * int(k % 25 / 5), 4, 6, 10) }'; }
studs 250 > studs.obj
said 'bplod studs.obj --up z --faces 2400 --levels 3 -o studs | cut -f 1,2,5' | some
studs 25 > studs.obj
said 'bplod studs.obj --up z --faces 2400 --levels 3 -o studs --overwrite | cut -f 1,2,5' | some
said 'bplod studs.obj --up z --faces 40 --levels 3 --resolution 64 -o studs --overwrite | cut -f 1,2' | some
ls studs
rm -r studs studs.obj
for f in chosen/cubes.glb chosen2/cubes.glb; do bpcheck part[01].obj $f | tail -1; done

# What bpinfo says of a tileset.
bplod cube.obj --name c --voxel 0.05 --tile 64 --faces 12 --up z --profile 3dtiles -q -o info > list
said 'bpinfo info/tileset.json | sed -E "s/, [0-9.]+ KiB/, SOME KiB/; s/(error|bounds) .*/\1 SOME/; s/input .*/input SOME/"'
bpinfo info/tileset.json --json | grep -E '"(kind|tiles|contents|missing|up)"'
rm info/c_LOD0/1_*
said 'bpinfo info/tileset.json | grep missing'
try bpinfo info/tileset.json --dump
# Drawn, it is drawn whole: a level of all tiles, upright, in the place of its scene.
bplod part*.obj --name cubes --resolution 160 --tile 128 --levels 3 --up z --profile 3dtiles -q -o drawn > list
bpinfo part*.obj drawn/tileset.json --up z --image beside.png --image-size 64 > said
for level in 0 1 2; do bpinfo drawn/tileset.json --level $level --image $level.png --image-size 99 > said; done
cmp -s 0.png 1.png && echo 'levels look the same'
bpinfo drawn/tileset.json --image finest.png --image-size 99 > said && cmp 0.png finest.png
said 'bpinfo drawn/tileset.json --up y --image up.png --image-size 99 > said' && cmp 0.png up.png
tiles=(drawn/cubes_LOD0/*)
rm "${tiles[1]}"
said 'bpinfo drawn/tileset.json --image hole.png > said' | sed -E 's/of [0-9]+ c/of SOME c/; s/[0-9]+_[0-9_]+.glb/SOME.glb/'
try bpinfo drawn/tileset.json --image none.png --level 9 | grep -e --level
try bpinfo drawn/tileset.json --level 1
try bpinfo cube.obj --level 1
try bpinfo gltf/cubes.glb --level 2
bpinfo gltf/cubes_LOD0.glb --level 0 | grep triangles
try bpinfo gltf/cubes_LOD0.glb --level 1
bpinfo gltf/cubes.glb --level 1 | grep -E 'levels|triangles'
rm -r drawn ./*.png said

# Findings of a tileset.
cp -r tiles broken
rm broken/cubes_LOD0.glb
sed -i '0,/"geometricError": .*/s//"geometricError": 1e-3,/' broken/tileset.json
bpcheck broken/tileset.json | sed 's/the root.s .*/the root/'
cp gltf/cubes_LOD0.glb tiles/  # not relative to the tileset's transform
bpcheck tiles/tileset.json | sed 's/[0-9]* of [0-9]*/some/; s/by up to.*//'
try bpcheck cube.obj nothing.json
try bplod cube.obj
try bplod cube.obj -o gltf --name cubes
try bplod cube.obj -o x --faces 5,10
try bplod cube.obj -o x --faces 50,10 --error 1
try bplod cube.obj -o x --levels 3 --faces 50,10
try bplod cube.obj -o x --error 3vx
try bplod cube.obj -o x --profile collision --faces 50,10
try bplod missing.obj -o x
try bplod cube.obj --name a/b -o x
files
echo "A fit is closed by a ball"
bplod part*.obj --name cubes --faces 100 --mode fit --resolution 60 -q -o element > said
bpinfo element/cubes_LOD0.glb | grep -o 'element=[a-z]*'
# A closed mesh has at least 4 faces, whatever is asked for.
write_octahedron least.obj 4
try bplod least.obj --faces 1 --resolution 20 -o least -q --report least.json > /dev/null
grep -o '"level 0: .*tetrahedron"' least.json
