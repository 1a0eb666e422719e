# Quads: in OBJ and PLY, enclosing as they are read; refused elsewhere.
write_cube cube.obj 3
bpvox cube.obj --resolution 20 -o cube.bpv
try bpmesh cube.bpv --faces 12 --quads -o quads.obj
grep '^f' quads.obj
bpcheck cube.obj quads.obj | tail -1
printf 'v 0 0 0\nv 9 1 0\nv 2 8 1\nv 3 2 7\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' > slanted.obj
bpvox slanted.obj --resolution 50 -o slanted.bpv
try bpmesh slanted.bpv --faces 200,60 --quads -o quads.ply
bpcheck slanted.obj quads.0.ply | tail -1
bpcheck quads.0.ply quads.1.ply | tail -1
try bpmesh cube.bpv --faces 12 --quads -o quads.glb
try bpmesh cube.bpv --faces 12 --quads -o -
files
