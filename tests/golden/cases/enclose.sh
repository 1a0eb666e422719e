# The scene's triangles stay inside wherever its files are at hand; else its voxels do, and a note says why.
write_octahedron oct.obj 10
enclosed() { grep -o '"enclosed": "[a-z]*"' r.json; rm r.json; }
volume() { bpinfo "$1" --json | grep '"volume"' | grep -o '[0-9.]*'; }
pipe='bpvox oct.obj --resolution 40 | bpclose --scale 5% | bpmesh --faces 20 --report r.json --overwrite'
said "$pipe -o auto.ply"
enclosed
said "$pipe --enclose oct.obj -o files.ply"
said "$pipe --enclose scene -o scene.ply -j 1 --memory 300M" && enclosed
[ "$(bpinfo auto.ply | checksum)" = "$(bpinfo files.ply | checksum)" ] && echo "the same proxy"
cmp auto.ply scene.ply && echo "the same bytes"
said "$pipe --enclose input -o input.ply" && enclosed
said "$pipe --enclose closing -o closing.ply" && enclosed
for f in auto input closing; do echo "$f $(volume $f.ply)"; done | sort -n -k 2 | cut -d ' ' -f 1 | tr '\n' ' '; echo
bpinfo auto.ply | grep -o 'enclose=[a-z]*'
bpcheck oct.obj auto.ply | tail -1

# The stream says where it comes from, and so does its closing. Other commands see the files from their own folder.
bpvox oct.obj --resolution 40 -o oct.bpv
bpclose oct.bpv --scale 5% -o closed.bpv
bpinfo closed.bpv | grep 'scene file'
bpinfo closed.bpv --dump | grep '^scene'
bpinfo closed.bpv --json | grep -A 11 '"scene"'
mkdir elsewhere && (cd elsewhere && try bpmesh ../closed.bpv --faces 20 -o there.ply --report r.json && enclosed && bpinfo there.ply | grep -o 'enclose=[a-z]*')

# What is not what it was is not taken.
remesh() { try bpmesh closed.bpv --faces 20 -o x.ply --overwrite --report r.json "$@" && enclosed; }
cp oct.obj good.obj
sed -i 's/^v 10/v 09/' oct.obj
remesh
try bpmesh closed.bpv --enclose scene --faces 20 -o x.ply --overwrite
echo '# a comment' >> oct.obj
remesh
sed 's/5/./' good.obj > oct.obj
remesh
cp good.obj oct.obj
remesh
try bpmesh closed.bpv --faces 20 -o oct.obj --overwrite
cmp good.obj oct.obj && echo "the scene is there"
mv oct.obj moved.obj
remesh
remesh -q
remesh --enclose input
said 'bpvox - --format obj --resolution 40 < good.obj | bpclose --scale 5% | bpmesh --faces 20 -o x.ply --overwrite'
mkfifo oct.obj
remesh
rm oct.obj

# Side files count as far as triangles depend on them.
printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f' > buffer.ply  # a corner of a cube
printf '\0\2\1\0\1\3\1\2\3\2\0\3' >> buffer.ply
cat > side.gltf << 'GLTF'
{"asset": {"version": "2.0"}, "buffers": [{"uri": "buffer.ply", "byteLength": 60}],
 "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
               {"bufferView": 1, "componentType": 5121, "count": 12, "type": "SCALAR"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0}
GLTF
bpvox side.gltf --resolution 40 -o side.bpv
try bpmesh side.bpv --faces 12 -o side.ply --report r.json && enclosed
try bpmesh side.bpv --faces 12 -o buffer.ply --overwrite
printf '\x40' | dd of=buffer.ply bs=1 seek=14 conv=notrunc 2> /dev/null
try bpmesh side.bpv --faces 12 -o side.ply --report r.json --overwrite && enclosed

# Where triangles are of no use, none are read.
cp good.obj oct.obj
remesh --mode fit
bpclose oct.bpv --scale 5% --element ball -o closed.bpv --overwrite
remesh --mode fit
remesh --mode fit --error 2%
remesh --error 2%
bpvox oct.obj --fill inside --resolution 40 | bpclose --scale 5% -o closed.bpv --overwrite
remesh --mode inside
try bpmesh closed.bpv --enclose auto --enclose oct.obj --faces 20 -o y.ply
try bpmesh closed.bpv --enclose oct.obj --enclose input --faces 20 -o y.ply

# The number of triangles decides, and memory does not: what does not fit is refused.
bp-plant --triangles 200000 -o plant.ply > said
bpvox plant.ply --resolution 100 -o plant.bpv
said 'bpmesh plant.bpv --faces 2000 -o p.ply -j 1 --memory 80M' | sed 's/[0-9]* MiB/N MiB/g'
try bpmesh plant.bpv --faces 4000 -o p.ply -j 1 --memory 80M --enclose input
said 'bplod plant.ply --faces 2000 --resolution 100 -o lod -j 1 --memory 128M' | sed 's/[0-9]* MiB/N MiB/g'
bp-plant --triangles 1100000 -o plant.ply --overwrite > said
bpvox plant.ply --resolution 50 -o plant.bpv --overwrite
try bpmesh plant.bpv --faces 2000 -o p.ply --overwrite
bplod plant.ply --faces 2000 --resolution 50 -o lod 2>&1 | grep "more than"
rm -rf plant.* p.ply said lod

# bplod: the triangles, of levels that are one mesh.
level() { bpinfo "$1" | grep -o 'enclose=[a-z]*'; }
try bplod oct.obj --faces 20 --resolution 40 -o lod && level lod/oct_LOD0.glb
said 'bplod oct.obj --faces 20 --resolution 40 --profile collision -o lod | cut -f 1,2' && level lod/oct_unity.glb
bpcheck oct.obj lod/oct_LOD0.glb | tail -1
said 'bplod - --name oct --format obj --faces 20 --resolution 40 -o lod --overwrite < oct.obj | cut -f 1,2' && level lod/oct_LOD0.glb
said 'bplod oct.obj --enclose input --faces 20 --resolution 40 -o lod --overwrite | cut -f 1,2' && level lod/oct_LOD0.glb
said 'bplod oct.obj --faces 20 --resolution 40 --profile 3dtiles -o tiles | cut -f 1' && level tiles/tileset.json
try bplod oct.obj --enclose scene --profile 3dtiles -o tiles2
said 'bplod - --name oct --format obj --enclose scene --faces 20 -o lod2 < oct.obj'

# A budget that parts and holes keep out of reach: bpmesh says what keeps them apart, and bplod takes a larger scale.
awk 'function box(x, y, z, w, d, h,  i) {
  for (i = 0; i < 8; ++i) print "v", x + (i % 2) * w, y + (int(i / 2) % 2) * d, z + int(i / 4) * h
  split("0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2 1 3 7 5", c)
  for (i = 1; i <= 24; i += 4) print "f", n + c[i] + 1, n + c[i + 1] + 1, n + c[i + 2] + 1, n + c[i + 3] + 1
  n += 8
}
BEGIN { for (k = 0; k < 8; ++k) { box(4 * k, 0, 0, 1, 29, 1); box(0, 4 * k, 0, 29, 1, 1) } }' > grid.obj
bpvox grid.obj --resolution 120 -o grid.bpv
bpclose grid.bpv --scale 1% -o closed.bpv --overwrite
try bpmesh closed.bpv --faces 60 -o grid.ply | sed 's/[0-9]* faces/N faces/; s/ (tries refused.*//'
said 'bplod grid.obj --up y --scale 0.3 --faces 60 --resolution 120 -o lod --overwrite | cut -f 1'
for i in 0 1 2 3 4; do  # five that lie apart: 20 faces at least, unless closed together
  awk -v d=$((14 * i)) '/^v/ { $2 += d } { print }' good.obj > part$i.obj
done
said 'bplod part?.obj --name parts --scale 0.5 --faces 16 --resolution 120 -o lod | cut -f 1'
