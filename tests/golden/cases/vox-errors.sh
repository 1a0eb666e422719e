# What bpvox refuses, what it says, and that no output stays behind.
write_cube cube.obj
: > empty.obj
printf 'v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' > nan.obj
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 1 2 9\n' > partly.obj
try bpvox
try bpvox missing.obj -o out.bp
try bpvox empty.obj -o out.bp
try bpvox nan.obj -o out.bp
try bpvox . -o out.bp
try bpvox cube.obj --voxel 0 -o out.bp
try bpvox cube.obj --voxel -1 -o out.bp
try bpvox cube.obj --voxel nan -o out.bp
try bpvox cube.obj --voxel 3vx -o out.bp
try bpvox cube.obj --voxel 1 --resolution 5 -o out.bp
try bpvox cube.obj --resolution 99999999999 -o out.bp
try bpvox cube.obj --resolution 99999999999999999999 -o out.bp
try bpvox cube.obj --resolution 10000000 -o out.bp
try bpvox cube.obj --resolution 1e3 -o out.bp
try bpvox cube.obj --resolution 0 -o out.bp
try bpvox cube.obj --voxel 1e-7 -o out.bp
try bpvox cube.obj --voxel 1e-12 -o out.bp
try bpvox cube.obj --fill concrete -o out.bp
try bpvox cube.obj --up w -o out.bp
try bpvox - -o out.bp
try bpvox cube.obj --temp missing -o out.bp
try bpvox cube.obj -o missing/out.bp
bpvox cube.obj --resolution 10 > stream
try bpvox stream -o out.bp
stdin=stream try bpvox - --format glb -o out.bp
rm stream
touch out.bp
try bpvox cube.obj -o out.bp
rm out.bp
try bpvox cube.obj -o /dev/full
said 'bpvox cube.obj --resolution 300 | head -c 10 | wc -c'
try bpvox partly.obj --voxel 0.125 -o partly.bp
# Quiet, it is left to the report.
try bpvox partly.obj --voxel 0.125 -q --report quiet.json -o quiet.bp
grep skipped quiet.json
files

# A GLB of points is a point cloud.
points='{"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":0}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}'
echo "$points" > points.gltf
try bpvox points.gltf -o points.bpv
# So are lines named, in OBJ and glTF.
echo "${points/\"mode\":0/\"mode\":3}" > lines.gltf
try bpvox lines.gltf -o lines.bpv
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\nl 1 3\n' > lines.obj
try bpvox lines.obj -o lines.bpv
# Of IFC one schema is read.
printf "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n" > new.ifc
try bpvox new.ifc -o new.bpv
# Endings of other formats.
for name in x.fbx x.dae x.usd x.blend x.gltf.gz x.png; do try bpvox cube.obj -o $name; done
# A grid by its resolution is questioned as one by its voxel.
try bpvox cube.obj --resolution 100000 -o grid.bpv

# A winding that does not close is told: the first quad is turned as a whole.
write_cube turned.obj
awk '/^f / && !n++ { printf "f"; for (i = NF; i > 1; --i) printf " %s", $i; print ""; next } { print }' turned.obj > mixed.obj
try bpvox mixed.obj --resolution 16 --fill winding -o mixed.bpv
try bpvox mixed.obj --resolution 16 -o flooded.bpv
