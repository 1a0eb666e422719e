# A scene six million units out: 32-bit floats hold its proxy only around an origin, and bpcheck moves it back exactly.
write_cube cube.obj 3
sed 's/^v \(.*\) \(.*\) \(.*\)$/echo v $((\1 + 6000000)) $((\2 + 6000000)) \3/e' cube.obj > far.obj
bpvox far.obj --resolution 40 | bpclose --scale 2vx -o far.bpv
try bpmesh far.bpv --faces 12 -o far.stl
try bpmesh far.bpv --faces 12 --origin 6000000,6000000,0 -o far.stl
try bpcheck far.obj far.stl --no-distances --examples 0
try bpcheck far.obj far.stl --no-distances --origin 6000000,6000000,0
try bpcheck far.obj far.stl --origin 6000000.1,6000000,1e-9
