# A triangle left behind by mistake makes all voxels huge: it is told, with its place, and the voxels that suit the rest.
write_cube house.obj 8
cp "$BP_ROOT/tests/data/bugs/stray.obj" .
try bpvox stray.obj --resolution 64 -o far.bpv
try bplod stray.obj --profile collision -o out
sed -E 's/^v 10000(.) 10000(.) 10000(.)/v 6\1 6\2 6\3/' stray.obj > near.obj
try bpvox near.obj --resolution 64 -o near.bpv
# The triangle first: its place is where the scene is measured from.
(tail -1 stray.obj > face; grep ^v stray.obj; cat face; grep ^f stray.obj | sed '$d') > first.obj
try bpvox first.obj --resolution 64 -o first.bpv
try bpvox house.obj --resolution 64 -o house.bpv
# A flood that comes in by an open side is told. One side of the house is missing.
sed '$d' house.obj > open.obj
try bpvox open.obj --resolution 64 -o open.bpv
try bpvox open.obj --resolution 64 --fill winding -o winding.bpv
# A scale that is a fifth of the scene is said with what the same number of percent would be.
try bpclose house.bpv --scale 2 -o closed.bpv
# A wall stands upright, and a map lies flat.
printf 'v -5 0 -0.1\nv 5 0 -0.1\nv 5 4 -0.1\nv -5 4 0.1\nf 1 2 3 4\n' > wall.obj
bpvox wall.obj --resolution 32 > wall.bpv
try bpmesh wall.bpv --faces 20 -o wall2.glb
sed 's/-0.1/0/; s/0.1/0.3/' wall.obj > map.obj
bpvox map.obj --resolution 32 > map.bpv
try bpmesh map.bpv --faces 20 -o map.glb
