# Levels to look at: the scene's own triangles, fewer of them, or fits. Two cubes in a row, one with an image.
write_painted_cubes
visual=(part*.obj --name cubes --mode visual -q)

bplod "${visual[@]}" --faces 1000,12,8 -o few --report few.json | cut -f 1,2
grep -o '"from": "[a-z]*"' few.json
bpinfo few/cubes_LOD0.glb | grep -e triangles -e bounds
grep -ao '"images":[^]]*\]' few/cubes_LOD0.glb
grep -ao '"ids":[^]]*\]' few/cubes.glb
bpcheck --claimed part0.obj few/cubes_LOD0.glb || echo "= $?"
# The same bytes on one thread, and in little memory.
bplod "${visual[@]}" --faces 1000,12,8 -o again -j 1 --memory 300M > list
same few again
# Defaults: a small scene is its own finest level.
bplod "${visual[@]}" -o all | cut -f 1-3 | head -2
# Far from the origin a node has the place.
sed 's/^v \([^ ]*\) /v 100000\1 /' part0.obj > far.obj
bplod far.obj --mode visual --faces 100 -o far -q 2> notes | cut -f 1,2
grep -ao '"translation":[^]]*\]' far/far_LOD0.glb
# What a glTF says of its materials stays. An image that cannot be decoded is left out, and a note says so.
square() { printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0\0\0\0\0\0\0\200\77\0\0\200\77\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0'; }
places() { printf '\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0\0\0\200\77\0\0\200\77\0\0\0\0\0\0\200\77'; }
{ square; places; printf '\0\0\1\0\2\0\0\0\2\0\3\0'; } > square.bin
head -c 60 chequered.png > broken.png
echo '{"asset":{"version":"2.0"},"buffers":[{"uri":"square.bin","byteLength":92}],"bufferViews":[{"buffer":0,"byteLength":48},
  {"buffer":0,"byteOffset":48,"byteLength":32},{"buffer":0,"byteOffset":80,"byteLength":12}],
  "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},
  {"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],"images":[{"uri":"chequered.png"},{"uri":"broken.png"}],
  "samplers":[{"magFilter":9728,"wrapS":33071}],"textures":[{"source":0,"sampler":0},{"source":1}],
  "materials":[{"name":"pane","alphaMode":"MASK","alphaCutoff":0.25,"emissiveFactor":[0,0.5,0],"occlusionTexture":{"index":0,"texCoord":1,"strength":0.5},
  "normalTexture":{"index":1},"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"roughnessFactor":0.25,"metallicFactor":0.75},
  "extensions":{"KHR_materials_unlit":{}}}],"extensionsUsed":["KHR_materials_unlit"],
  "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":1},"indices":2,"material":0}]}],"nodes":[{"mesh":0}]}' > pane.gltf
bplod pane.gltf --mode visual --faces 100 -o pane 2> notes | cut -f 1,2
grep -o 'broken.png.*' notes
grep -ao '"samplers".*"materials":.*\]' pane/pane_LOD0.glb | tr -d '\n' | sed 's/,"nodes.*//'
echo
grep -ao '"attributes":{[^}]*}' pane/pane_LOD0.glb
# A shorter list replaces a longer one, and nothing that others made.
cp part0.obj few/cubes_LOD2.glb
bplod "${visual[@]}" --faces 8 -o few --overwrite | cut -f 1,2
ls few
try bplod part0.obj --mode visual --profile collision -o x
try bplod part0.obj --mode visual --error 1% -o x
try bplod part0.obj --mode visual --enclose input -o x
try bplod part0.obj --mode visual -o x/cube.obj
try bplod - --format obj --mode visual -o x
