# A scene six million units out: 32-bit floats hold its proxy only around an origin, and bpcheck moves it back exactly.
write_cube cube.obj 3
sed 's/^v \(.*\) \(.*\) \(.*\)$/echo v $((\1 + 6000000)) $((\2 + 6000000)) \3/e' cube.obj > far.obj
bpvox far.obj --resolution 40 | bpclose --scale 2vx -o far.bpv
try bpmesh far.bpv --faces 12 -o far.stl
try bpmesh far.bpv --faces 12 --origin 6000000,6000000,0 -o far.stl
try bpcheck far.obj far.stl --no-distances --examples 0
try bpcheck far.obj far.stl --no-distances --origin 6000000,6000000,0
try bpcheck far.obj far.stl --origin 6000000.1,6000000,1e-9
# Files that say that they were moved are told from those that enclose nothing.
for file in moved.glb moved.ply; do bpmesh far.bpv --faces 12 --origin 6000000,6000000,0 -q -o $file; done
for file in moved.glb moved.ply; do said "bpcheck far.obj $file --no-distances | tail -1"; done
for file in moved.glb moved.ply; do said "bpcheck far.obj $file --no-distances --origin=6000000,6000000,0 | tail -1"; done
bplod far.obj --voxel 0.1 --faces 12 --levels 1 --profile 3dtiles --name far -q -o tiles > list
said 'bpcheck far.obj tiles/far_LOD0.glb --no-distances | tail -1'
