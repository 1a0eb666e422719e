# A proxy strictly inside: voxels that the scene encloses and does not touch, their opening, proxies within each other.
write_cube cube.obj 3
said 'bpvox cube.obj --resolution 40 --fill inside | bpclose --scale 2vx | bpmesh --mode inside --faces 40,20,12 -o in.ply'
for i in 0 1 2; do bpcheck --inside cube.obj in.$i.ply | tail -1; done
for i in 0 1; do bpcheck --inside in.$i.ply in.$((i + 1)).ply | tail -1; done
try bpcheck --inside in.1.ply in.0.ply
said 'bpvox cube.obj --resolution 40 --fill inside -j 1 | bpclose --scale 2vx -j 1 | bpmesh --faces 40,20,12 -j 1 -o again.ply && cmp in.2.ply again.2.ply'
said 'bpvox cube.obj --resolution 40 | bpmesh --mode inside --faces 12 -o wrong.ply'
said 'bpvox cube.obj --resolution 40 --fill inside | bpmesh --mode bounding --faces 12 -o wrong.ply'
said 'bpvox cube.obj --resolution 40 --fill inside | bpmesh --mode inside --enclose cube.obj -o wrong.ply'
said 'bpvox cube.obj --resolution 2 --fill inside | bpmesh --mode inside -o wrong.ply'
files

# A scene whose T-junction is filled by a triangle of no area is closed.
{ write_cube /dev/stdout 3 | grep -v '^f 1 4 3 2'; printf 'v 0 1.5 0\nf 2 1 9 4 3\n'; } > split.obj
said 'bpcheck --inside split.obj in.2.ply | grep -E "strictly|hold"'
echo 'f 9 1 4' >> split.obj
said 'bpcheck --inside split.obj in.2.ply | grep -E "area|strictly|hold"'
# One from the proxy's surface to the outside meets the proxy.
cp "$BP_ROOT"/tests/data/bugs/occluder/thread_in_occluder.* .
said 'bpcheck --inside thread_in_occluder.obj thread_in_occluder.off | grep -E "area|strictly|hold"'
