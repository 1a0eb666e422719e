# What bpinfo says of a mesh.
write_cube cube.obj 2
try bpinfo cube.obj
try bpinfo cube.obj --json
# The order of faces, and the corner that each begins with, do not matter; orientation does.
(grep ^v cube.obj; echo 'f 3 2 1 4'; grep ^f cube.obj | tail -n +2 | tac) > turned.obj
(grep ^v cube.obj; echo 'f 1 2 3 4'; grep ^f cube.obj | tail -n +2) > flipped.obj
for file in cube turned flipped; do said "bpinfo $file.obj | checksum"; done
(grep ^v cube.obj; awk '/^f/ { print "f", $5, $4, $3, $2 }' cube.obj) > inverted.obj
said 'bpinfo inverted.obj | grep volume'
said 'bpcheck inverted.obj cube.obj | grep "volume of"'
said 'bpinfo --format obj < cube.obj | checksum'
said 'bpinfo cube.obj --image cube.png | checksum'
try bpinfo cube.obj --dump
stdin=cube.obj try bpinfo
(echo '# provenance: bpvox 0.1.0 voxel=1'; echo '# provenance: bpmesh 0.1.0 faces=12'; cat cube.obj) > made.obj
said 'bpinfo made.obj | grep made'
# Of a chain in one file the finest level is shown; steps are those of other formats.
write_ball round.obj
bplod round.obj --name cube --faces 200,20 --resolution 24 -q -o lods > list
rm round.obj
bpmesh <(bpvox cube.obj --resolution 12 | bpclose --scale 2vx) --faces 12 -q -o proxy.glb 2> /dev/null
said 'bpinfo lods/cube.glb | grep -E "levels|triangles"'
for level in 0 1; do said "bpinfo lods/cube.glb --level $level | grep -o '; level 0$'"; done
said 'bpinfo lods/cube.glb --level 1 --json | grep provenance_level'
said 'bpinfo proxy.glb | grep "made by.*bpvox" | grep -c "input [0-9a-f]\{32\}$"'
rm -r lods list proxy.glb
files
# Several inputs: one after the other, and side by side.
bpvox cube.obj --resolution 12 | bpclose --scale 2vx -o closed.bpv
said 'bpinfo cube.obj closed.bpv turned.obj --image all.png --image-size 64 | grep -c .'
try bpinfo closed.bpv --image wide.png --image-size 9000
head -c 20 all.png | tail -c 4 | od -An -tx1  # panels side by side; the height hangs on whether there is a font
# Inputs that lie far apart are drawn by themselves, which is said.
awk '/^v/ { print "v", $2 + 500, $3, $4; next } { print }' cube.obj > far.obj
try bpinfo far.obj cube.obj --image far.png --image-size 64 | grep far
try bpinfo cube.obj turned.obj --image near.png --image-size 64 | grep far
said 'bpinfo cube.obj turned.obj | checksum'
try bpinfo cube.obj turned.obj --json
try bpinfo cube.obj --up w
# What has no triangles is an error, as for other tools.
: > empty.obj
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' > flat.obj
for scene in empty.obj flat.obj; do try bpinfo $scene; done
rm empty.obj flat.obj
# Quads and other polygons are counted.
(cat cube.obj; echo 'f 1 2 3'; echo 'f 5 6 7 8 1') > faces.obj
said 'bpinfo cube.obj | head -3'
try bpinfo faces.obj | head -5
said 'bpinfo faces.obj --json | grep -A 4 \"faces\"'
said 'bpcheck cube.obj | head -1'
said 'bpcheck faces.obj | head -1'
# A part in detail. What no zoom can be is refused.
said 'bpinfo cube.obj --image part.png --image-size 64 --zoom 3 --look-at 0,0,0 | checksum'
bpinfo cube.obj --image whole.png --image-size 64 > said
cmp -s part.png whole.png && echo 'the same picture'
for zoom in 0 -1 1e9 nan x; do try bpinfo cube.obj --image no.png --zoom $zoom; done
try bpinfo cube.obj --image no.png --look-at 1,2
# Pictures of panels that are large enough have marks below them, and the same bytes each time.
bpinfo cube.obj turned.obj --image marks.png --image-size 200 > said
bpinfo cube.obj turned.obj --image again.png --image-size 200 --threads 1 > said
cmp marks.png again.png
[ $((16#$(od -An -tx1 -j 20 -N 4 marks.png | tr -d ' '))) -gt 240 ] || echo 'nothing is below the panels'
rm faces.obj part.png whole.png marks.png again.png said
# What moves a scene of glTF is counted.
bytes=$(printf '%b' '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0' | base64 -w 0)
cat > skin.gltf <<END
{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}], "skins": [{"joints": [1, 2]}, {"joints": [1]}],
 "nodes": [{"mesh": 0}, {"children": [2]}, {}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,$bytes"}]}
END
said 'bpinfo skin.gltf | grep moves'
said 'bpinfo skin.gltf --json | grep -E "skins|joints"'
rm skin.gltf
# Materials that are not there are named where colours would be seen.
(echo 'mtllib gone.mtl'; cat cube.obj) > plain.obj
said 'bpinfo plain.obj | checksum'
said 'bpinfo plain.obj --image plain.png | checksum'
rm plain.obj plain.png
files
