# Levels to look at: the scene's own triangles, fewer of them, or fits. Two cubes in a row, one with an image.
write_painted_cubes
visual=(part*.obj --name cubes --mode visual -q)

bplod "${visual[@]}" --faces 1000,12,8 -o few --report few.json | cut -f 1,2
grep -o '"from": "[a-z]*"' few.json
bpinfo few/cubes_LOD0.glb | grep -e triangles -e bounds
grep -ao '"images":[^]]*\]' few/cubes_LOD0.glb
grep -ao '"ids":[^]]*\]' few/cubes.glb
bpcheck --claimed part0.obj few/cubes_LOD0.glb || echo "= $?"
# The same bytes on one thread, and in little memory.
bplod "${visual[@]}" --faces 1000,12,8 -o again -j 1 --memory 300M > list
same few again
# Defaults: a small scene is its own finest level.
bplod "${visual[@]}" -o all | cut -f 1-3 | head -2
# Far from the origin a node has the place.
sed 's/^v \([^ ]*\) /v 100000\1 /' part0.obj > far.obj
bplod far.obj --mode visual --faces 100 -o far -q 2> notes | cut -f 1,2
grep -ao '"translation":[^]]*\]' far/far_LOD0.glb
try bplod part0.obj --mode visual --profile collision -o x
try bplod part0.obj --mode visual --error 1% -o x
try bplod part0.obj --mode visual --enclose input -o x
try bplod part0.obj --mode visual -o x/cube.obj
try bplod - --format obj --mode visual -o x
