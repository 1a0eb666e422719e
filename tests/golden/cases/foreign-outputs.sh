# Names of outputs that promise another kind of file than the tool writes: refused before any work, with the right name.
write_cube cube.obj 0.75
bpvox cube.obj --resolution 16 -o cube.bpv
for name in x.usd x.USDZ x.fbx x.dae x.3ds x.blend x.abc x.step x.ifc x.3dm x.gltf.gz x.zip x.png x.vdb x.bpv x.bpw x.ma; do
  try bplod cube.obj -o $name
done
try bplod cube.obj -o out/.usd
try bplod cube.obj -o x.obj --profile collision
try bplod cube.obj -o x.usd --profile occluder
try bplod cube.obj -o x.fbx --profile cage
try bplod cube.obj -o x.b3dm --profile 3dtiles
try bplod cube.obj -o x.usd --explain
for name in x.usd x.abc x.bpw x.7z; do try bpvox cube.obj -o $name; done
try bpclose cube.bpv -o x.ply
try bpclose cube.bpv -o x.bpw
for name in x.usd x.fbx x.vdb x.bpv noending; do try bpmesh cube.bpv -o $name; done
try bpinfo cube.bpv --image x.usd
for name in x.usd x.bpv x.vdb; do try bpdeform bind cube.obj cube.obj -o $name; done
try bp-plant -o x.usd
try bp-plant -o x.obj
try bpcheck cube.obj --report x.glb
try bpvox cube.obj -o x.bpv --report x.usd
files
# A folder that is there, or a slash, says that a folder is meant; an ending that nobody has is none.
mkdir there.max
try bplod cube.obj --faces 30 -q -o there.max
try bplod cube.obj --faces 30 -q -o slash.ma/
try bplod cube.obj --faces 30 -q -o v1.2
ls there.max slash.ma v1.2
