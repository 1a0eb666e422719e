# bpdeform: a scene bound to a cage, and moved with it.
write_cube cage.obj 4
write_octahedron scene.obj
echo 'vn 0 0 1' >> scene.obj
sed -i '1i mtllib scene.mtl\no part' scene.obj
sed -i 's/^v .*/& 0.5 0.25 1/' scene.obj
# The scene lies in the corner of the cage, on its faces.
try bpdeform bind scene.obj cage.obj -o scene.bpw
try bpdeform apply scene.bpw cage.obj -o rest.obj
said 'cmp rest.obj scene.obj && echo same'
# What is in the file of weights; it is read to its end.
try bpinfo scene.bpw
try bpinfo scene.bpw --json
try bpinfo scene.bpw --image weights.png
try bpinfo scene.bpw --dump
try bpinfo scene.bpw --boxes part
head -c -100 scene.bpw > cut.bpw
try bpinfo cut.bpw
stdin=scene.bpw try bpinfo
try bpclose scene.bpw --scale 1 -o x.bpv
# A scene that is missing or has changed.
mv scene.obj away.obj
said 'bpinfo scene.bpw | grep scene.file'
said 'bpinfo scene.bpw --json | grep bytes_now'
(cat away.obj; echo) > scene.obj
said 'bpinfo scene.bpw | grep scene.file'
mv away.obj scene.obj
# The whole cage moves: so does the scene. One side of it moves: the scene is stretched.
awk '/^v/ { $2 += 10; $3 *= 2 } { print }' cage.obj > affine.obj
try bpdeform apply scene.bpw affine.obj -o affine_scene.obj
said 'diff scene.obj affine_scene.obj'
awk '/^v/ && $2 == 4 { $4 += 1 } { print }' cage.obj > bent.obj
try bpdeform apply scene.bpw bent.obj -o bent_scene.obj -q
said 'grep "^v " bent_scene.obj'
# A sequence of cages gives a sequence of scenes.
try bpdeform apply scene.bpw cage.obj bent.obj affine.obj -o frame.obj
said 'cmp frame.0.obj scene.obj && cmp frame.1.obj bent_scene.obj && cmp frame.2.obj affine_scene.obj && echo same'
try bpdeform apply scene.bpw
# The same bytes for any number of threads and limit on memory.
try bpdeform bind scene.obj cage.obj -o again.bpw -j 1 --memory 100M
said 'cmp scene.bpw again.bpw && echo same'
# Other coordinates: the whole cage turns and grows, and so does the scene.
awk '/^v/ { x = $2; $2 = 9 - 2 * $3; $3 = 2 * x; $4 *= 2 } { print }' cage.obj > similar.obj
for kind in green maximum-likelihood; do
  try bpdeform bind scene.obj cage.obj -o kind.bpw --coordinates $kind --overwrite
  said "bpinfo kind.bpw | grep -E '^(coordinates|vertices)'"
  try bpdeform apply kind.bpw cage.obj -o kind.obj -q --overwrite
  said 'cmp kind.obj scene.obj && echo same'
  try bpdeform apply kind.bpw similar.obj -o kind.obj -q --overwrite
  said "awk '/^v / { printf \"%.5f %.5f %.5f\\n\", \$2, \$3, \$4 }' kind.obj"
done
try bpdeform apply kind.bpw similar.obj -o kind.obj --coordinates green
# The scene is found from any folder.
mkdir -p elsewhere/weights
try bpdeform bind scene.obj cage.obj -o elsewhere/weights/scene.bpw
said '(cd elsewhere && bpdeform apply weights/scene.bpw ../cage.obj -o rest.obj -q) && cmp elsewhere/rest.obj scene.obj && echo same'
mkdir alone && cp scene.bpw alone
said '(cd alone && bpdeform apply scene.bpw ../cage.obj -o rest.obj)'
# In another folder it lacks what it names: that is said, once.
mkdir images
echo 'newmtl red
map_Kd -s 1 1 1 images/red.png' > scene.mtl
touch images/red.png
try bpdeform apply scene.bpw cage.obj -o elsewhere/moved.obj
try bpdeform apply scene.bpw cage.obj cage.obj -o elsewhere/frame.obj
cp -r scene.mtl images elsewhere
try bpdeform apply scene.bpw cage.obj -o elsewhere/moved.obj --overwrite
printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0' > one.bin
echo '{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
  "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
  "images": [{"uri": "images/dark%20red.png"}], "buffers": [{"uri": "one.bin", "byteLength": 36}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}]}' > one.gltf
touch 'images/dark red.png'
try bpdeform bind one.gltf cage.obj -o one.bpw
try bpdeform apply one.bpw cage.obj -o moved_one.gltf
try bpdeform apply one.bpw cage.obj -o elsewhere/one.gltf
rm -r images scene.mtl one.gltf one.bin one.bpw moved_one.gltf
rm -r elsewhere alone
# PLY and GLB keep their format; the cage may come in any.
said 'bpvox scene.obj --resolution 20 -q | bpclose -q | bpmesh --faces 20 -q -o scene.glb'
for kind in glb ply; do
  [ $kind = glb ] || said 'bpvox scene.obj --resolution 20 -q | bpclose -q | bpmesh --faces 20 -q -o scene.ply'
  try bpdeform bind scene.$kind cage.obj -o kind.bpw --overwrite --outside near -q
  try bpdeform apply kind.bpw affine.obj -o moved.$kind
  said "bpinfo scene.$kind | grep -E '^(triangles|bounds)'"
  said "bpinfo moved.$kind | grep -E '^(triangles|bounds)'"
  try bpdeform apply kind.bpw cage.obj affine.obj -o moving.$kind --animate 24
done
try bpdeform apply kind.bpw cage.obj -o moving.ply --animate 0
try bpdeform apply scene.bpw cage.obj affine.obj -o moving.glb --animate 24
try bpdeform bind scene.ply cage.obj -o x.bpw --animate 24
# A glTF whose cage moves: a scene for each key of its animation, or an animation of so many cages a second.
said 'bpvox cage.obj --resolution 10 -q | bpclose -q > box.bpv; bpmesh box.bpv --faces 12 -q -o box.glb; bpmesh box.bpv --faces 12 -q -o box.obj'
awk '/^v/ { $2 = 2 * $2 } { print }' box.obj > wide.obj
try bpdeform bind box.glb box.obj -o box.bpw --outside near -q
try bpdeform apply box.bpw box.obj wide.obj -o moving_box.glb --animate 2 -q
said "bpinfo moving_box.glb | grep moves"
said "bpinfo moving_box.glb --json | grep -E 'animations|morph'"
try bpdeform bind scene.obj box.glb -o boxed.bpw
try bpdeform apply boxed.bpw moving_box.glb -o boxed.obj -q
said "cmp boxed.0.obj scene.obj && awk '/^v / { printf \"%.4f %.4f %.4f\\n\", \$2 + 1e-6, \$3, \$4 }' boxed.1.obj"
try bpdeform bind scene.glb box.glb -o boxed.bpw --overwrite --outside near -q
try bpdeform apply boxed.bpw moving_box.glb -o moving_scene.glb --animate 8
# The same bytes on any device; and where it does not belong.
try bpdeform bind scene.obj cage.obj -o again.bpw --overwrite --device cpu
said 'cmp scene.bpw again.bpw && echo same'
try bpdeform apply scene.bpw cage.obj -o x.obj --device cpu
# Vertices outside.
write_octahedron large.obj 5
try bpdeform bind large.obj cage.obj -o large.bpw
try bpdeform bind large.obj cage.obj -o large.bpw --outside near
try bpdeform apply large.bpw affine.obj -o moved_large.obj
said 'grep "^v " moved_large.obj'
# What does not fit.
try bpdeform
try bpdeform bend scene.obj cage.obj -o x.bpw
try bpdeform bind scene.obj -o x.bpw
try bpdeform bind scene.obj cage.obj
try bpdeform bind - cage.obj -o x.bpw
try bpdeform bind missing.obj cage.obj -o x.bpw
try bpdeform bind scene.obj cage.obj -o scene.bpw
try bpdeform bind scene.obj scene.obj -o scene.obj --overwrite
# Scene and cage in the wrong order.
try bpdeform bind cage.obj large.obj -o x.bpw
try bpdeform bind cage.obj scene.obj -o x.bpw
grep -v '^f 1 4' cage.obj > open.obj
try bpdeform bind scene.obj open.obj -o x.bpw
try bpdeform apply scene.bpw open.obj -o x.obj
sed 's/^f 1 4 3 2/f 4 3 2 1/' cage.obj > turned.obj
try bpdeform apply scene.bpw turned.obj -o x.obj
sed '0,/^v .*/s//v nan 0 0/' cage.obj > nan.obj
try bpdeform apply scene.bpw nan.obj -o x.obj
try bpdeform apply scene.bpw affine.obj -o x.ply
try bpdeform apply scene.bpw affine.obj -o scene.obj --overwrite
try bpdeform apply scene.bpw affine.obj -o x.obj --outside near
try bpdeform apply scene.obj affine.obj -o x.obj
head -c 200 scene.bpw > cut.bpw
try bpdeform apply cut.bpw affine.obj -o x.obj
sed -i 's/^v 1 /v 2 /' scene.obj
try bpdeform apply scene.bpw affine.obj -o x.obj
echo 'v 1 2 3' >> scene.obj
try bpdeform apply scene.bpw affine.obj -o x.obj
try bpdeform bind moved.ply.stl cage.obj -o x.bpw
files
