# Colours of materials on levels. Three cubes in a row; what is compared is bytes with bytes.
printf 'newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\nnewmtl white\nKd 1 1 1\n' > cubes.mtl
write_cube cube.obj 3
for i in 0 1 2; do
  { echo "mtllib cubes.mtl"; sed "s/^v \(.*\) \(.*\) \(.*\)$/echo v \$((\1 + 7 * $i)) \2 \$((\3 + $i))/e; s/^f 1 4 3 2/usemtl $([ $i = 2 ] && echo green || echo red)\n&/" cube.obj; } > part$i.obj
done
attributes() { for f in "$@"; do echo "$f: $(grep -ao '"attributes":{[^}]*}' "$f" | sort -u | tr '\n' ' ')"; done; }

bplod part*.obj --name cubes --resolution 100 --levels 2 -q -o on | cut -f 1
bplod part*.obj --name cubes --resolution 100 --levels 2 -q -o on1 -j 1 --memory 300M > list
same on on1
bplod part*.obj --name cubes --resolution 100 --levels 2 -q -o off --appearance off > list
attributes on/*.glb off/*.glb
for f in cubes_LOD0 cubes_LOD1; do
  [ "$(bpinfo on/$f.glb | checksum)" = "$(bpinfo off/$f.glb | checksum)" ] && echo "$f: the same triangles"
done

# Where nothing is coloured, nothing is written: materials that are white, or not there.
sed -i 's/^Kd .*/Kd 1 1 1/' cubes.mtl
bplod part*.obj --name cubes --resolution 100 --levels 2 -q -o white > list
same white off
printf 'newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n' > cubes.mtl

# Tilesets: the cache knows colours. One part changes its colour alone.
options=(part*.obj --name cubes --voxel 0.1 --tile 128 --profile 3dtiles -q)
bplod "${options[@]}" -o first --cache cache > list
bplod "${options[@]}" -o again -j 1 --cache cache --report again.json > list
same first again
kept again.json
sed -i 's/Kd 0 1 0/Kd 0 0 1/' cubes.mtl
bplod "${options[@]}" -o painted --cache cache --report painted.json > list
bplod "${options[@]}" -o from-nothing > list
same painted from-nothing
same painted first
kept painted.json
attributes first/cubes_LOD0/*.glb | cut -d : -f 2- | sort -u
bpcheck part*.obj painted/tileset.json | sed 's/[0-9]* triangles/some triangles/'

# Fits have colours, too; a collision mesh has none.
bplod part*.obj --name cubes --resolution 60 --levels 1 --mode fit -q -o fit | cut -f 1
bplod "${options[@]}" --levels 2 --mode fit -o fit-tiles > list
bplod part*.obj --name cubes --resolution 60 --profile collision -q -o collision > list
attributes fit/*.glb collision/cubes_unity.glb
attributes fit-tiles/*/*.glb | cut -d : -f 2- | sort -u
bpinfo fit/cubes_LOD0.glb --image fit.png --image-size 64 | tail -1 | cut -c 1-8
files
# Colours that the scene names and does not have are missed.
rm cubes.mtl
said 'bplod part0.obj --name cubes --resolution 30 --levels 1 -o colourless | cut -f 1'
said 'bplod part0.obj --name cubes --resolution 30 --levels 1 --appearance off -o colourless-too | cut -f 1'

# Where a red side meets a white one, each vertex has one of the two colours.
printf 'newmtl red\nKd 1 0 0\nnewmtl white\nKd 1 1 1\n' > cubes.mtl
awk 'NR == 1 { print "mtllib cubes.mtl" } /^f / { if (++n < 3) print "usemtl " (n == 1 ? "red" : "white") } { print }' cube.obj > two.obj
for mode in bounding fit; do
  bplod two.obj --resolution 90 --levels 1 --mode $mode --appearance color -q -o $mode.obj > list
  grep '^v ' $mode.obj | cut -d ' ' -f 5- | sort -u | sed "s/^/$mode: /"
done
