# What bpinfo says of a mesh.
write_cube cube.obj 2
try bpinfo cube.obj
try bpinfo cube.obj --json
# The order of faces, and the corner that each begins with, do not matter; orientation does.
(grep ^v cube.obj; echo 'f 3 2 1 4'; grep ^f cube.obj | tail -n +2 | tac) > turned.obj
(grep ^v cube.obj; echo 'f 1 2 3 4'; grep ^f cube.obj | tail -n +2) > flipped.obj
for file in cube turned flipped; do try bpinfo --checksum $file.obj; done
stdin=cube.obj try bpinfo --format obj --checksum
try bpinfo cube.obj --image cube.png --checksum
try bpinfo cube.obj --dump
stdin=cube.obj try bpinfo
(echo '# provenance: bpvox 0.1.0 voxel=1'; echo '# provenance: bpmesh 0.1.0 faces=12'; cat cube.obj) > made.obj
said 'bpinfo made.obj | grep made'
files
