# A tileset is a scene. Two cubes in a row, one with an image; the leaves of the tileset hold them.
write_painted_cubes
bplod part*.obj --name cubes --voxel 0.1 --tile 128 --profile 3dtiles --leaves scene -o tiles -q > list
bpvox part*.obj --voxel 0.7 -o scene.bpv
bpvox tiles --voxel 0.7 -o again.bpv
for of in scene again; do bpinfo $of.bpv | grep '^solid\|^checksum'; done | sort | uniq -c | sed 's/^ *//'
bpvox tiles/tileset.json --voxel 0.1 | bpclose --scale 1 | bpmesh --faces 100 -o proxy.glb -q
bpcheck part*.obj proxy.glb | tail -1
bpcheck tiles proxy.glb | tail -1
# It has its images: they are those of the levels.
bplod tiles --name level --faces 100 --voxel 0.5 -o levels -q > list
grep -ao '"mimeType":"[^"]*"' levels/level_LOD0.glb
# It is read again by later tools, and is never replaced.
bpmesh again.bpv --faces 50 -o proxy.obj -q && bpcheck tiles/tileset.json proxy.obj | tail -1
try bplod tiles --name cubes --voxel 0.5 --profile 3dtiles -o tiles --overwrite
# Below a tileset that stands elsewhere: 1000 along x.
echo '{"asset":{"version":"1.1"},"geometricError":9,"root":{"refine":"ADD","geometricError":1,"boundingVolume":{"sphere":[0,0,0,1]},
  "transform":[1,0,0,0,0,1,0,0,0,0,1,0,1000,0,0,1],"content":{"uri":"tiles/tileset.json"}}}' > far.json
bpvox far.json --voxel 0.1 -o far.bpv
bpinfo far.bpv | grep '^scene '
# A scene that is not whole is refused, by all tools in the same words.
echo '{"asset":{"version":"1.1"},"geometricError":1}' > rootless.json
try bpcheck rootless.json
try bplod rootless.json -o x
said 'bplod - --format gltf -o x < rootless.json'
rm "$(ls tiles/cubes_leaves/*.glb | head -1)"
try bpvox tiles --voxel 0.1 -o broken.bpv 2>&1 | sed 's/cubes_leaves.*/.../'
sed -i 's|tiles/tileset.json|far.json|' far.json
try bpvox far.json --voxel 0.1 -o broken.bpv
