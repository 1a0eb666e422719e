# What bpcheck cannot read or do: one line and the status that docs/exit-codes.md says.
write_cube cube.obj 1
try bpcheck
try bpcheck missing.obj
try bpcheck missing.obj cube.obj
try bpcheck cube.obj missing.obj
echo nothing > noise.qqq
try bpcheck noise.qqq
: > empty.obj
try bpcheck empty.obj
# The same fault ends with the same code in every format, for scenes and for meshes.
for format in obj stl ply off glb gltf dae; do
  : > "none.$format"
  try bpcheck cube.obj "none.$format"
  try bpvox "none.$format" -o none.bpv
done
mkdir folder
try bpcheck cube.obj folder
try bpvox folder -o none.bpv
rm -r none.* folder
try bpinfo cube.obj --image missing/cube.png
try bpinfo cube.obj --image cube.png --image-size 3
bpvox cube.obj --resolution 10 -o cube.bpv
try bpcheck cube.bpv
try bpcheck cube.bpv cube.obj
stdin=cube.bpv try bpcheck - cube.obj --format obj
try bpinfo cube.obj --image cube.jpg
try bpcheck cube.obj --origin 1,2
try bpcheck cube.obj --origin 1e-20,0,0
said 'bpcheck cube.obj > /dev/full'
files
