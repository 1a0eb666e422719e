# Levels as OBJ, with a material and an image beside each. Two cubes in a row, one with a chequered image.
write_painted_cubes
options=(part*.obj --resolution 60 -q)
bplod "${options[@]}" --levels 2 -o out/cubes.obj | cut -f 1
bplod "${options[@]}" --levels 2 -o again/cubes.obj -j 1 --memory 300M > list
same out again
ls out
awk -F '\t' 'NR > 1 { n += $6 } END { print n }' list | diff - <(cat again/* | wc -c) && echo "all bytes are listed"
cat out/cubes_LOD1.mtl
grep -v '^[v#f]' out/cubes_LOD1.obj
bplod "${options[@]}" --levels 2 --name cubes -o glb > list
for f in cubes_LOD0 cubes_LOD1; do
  [ "$(bpinfo out/$f.obj | checksum)" = "$(bpinfo glb/$f.glb | checksum)" ] && echo "$f: the same triangles"
done
bpcheck part*.obj out/cubes_LOD0.obj | tail -1

# A level by itself has the name as it is. What answers to light is in images of its own; colours may lie on the vertices.
bplod "${options[@]}" --levels 1 --appearance full -o one/cube.obj > list && ls one && cat one/cube.mtl
bplod "${options[@]}" --levels 1 --appearance color -o one/cube.obj --overwrite > list && ls one
grep -m 1 '^v ' one/cube.obj | wc -w
bplod "${options[@]}" --levels 1 --appearance off -o off.OBJ > list && ls off*
# Names of materials and images have no blanks: many readers part them there.
bplod "${options[@]}" --levels 1 -o 'blank/a cube.obj' > list && ls blank && grep -h 'mtl \|_color\|^mtllib' blank/a*.{obj,mtl}
bplod 'blank/a cube.obj' --resolution 30 --levels 1 -q -o read/level.obj > list && ls read
bpcheck part*.obj 'blank/a cube.obj' | tail -1
# A level of the other name has files of its own.
bplod "${options[@]}" --levels 1 -o blank/a_cube.obj > list && ls blank && grep -h '^mtllib' blank/*.obj
rm blank/a_cube*
# What only an earlier level of ours named goes with it.
touch blank/a~_cube_normal.png blank/other_color.jpg
bplod "${options[@]}" --levels 1 --appearance off -o 'blank/a cube.obj' --overwrite > list && ls blank
echo 'mtllib part0.mtl' > 'blank/part0.obj' && touch blank/part0.mtl
bplod "${options[@]}" --levels 1 --appearance off -o blank/part0.obj --overwrite > list && ls blank/part0*
said 'bplod part0.obj --levels 1 --resolution 30 -o plain.obj 2>&1 | tail -1'
try bplod part0.obj --levels 1 --resolution 30 -o plain.obj -q
try bplod part0.obj --levels 1 --resolution 30 -o part0.obj -q --overwrite
try bplod part0.obj --name x -o x.obj
try bplod part0.obj --profile collision -o x.obj
