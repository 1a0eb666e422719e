# Quads: in OBJ and PLY, enclosing as they are read; refused elsewhere.
write_cube cube.obj 3
bpvox cube.obj --resolution 20 -o cube.bpv
try bpmesh cube.bpv --faces 12 --quads -o quads.obj
grep '^f' quads.obj
bpcheck cube.obj quads.obj | tail -1
write_ball slanted.obj 9
bpvox slanted.obj --resolution 50 -o slanted.bpv
try bpmesh slanted.bpv --faces 200,60 --quads -o quads.ply
bpcheck slanted.obj quads.0.ply | tail -1
bpcheck quads.0.ply quads.1.ply | tail -1
try bpmesh cube.bpv --faces 12 --quads -o quads.glb
try bpmesh cube.bpv --faces 12 --quads -o -
files
