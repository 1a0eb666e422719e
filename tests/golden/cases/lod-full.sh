# Normals, roughness, metal and light of a scene on its levels. A cube whose material has an image for each.
chequer red
one='\000\000\200\077' zero='\000\000\000\000'
for part in position place; do
  for i in 0 1 2 3 4 5 6 7; do
    for k in $([ $part = place ] && echo 1 2 || echo 1 2 4); do [ $((i & k)) = 0 ] && printf "$zero" || printf "$one"; done
  done
done > cube.bin
printf '\0\2\3\0\3\1\4\5\7\4\7\6\0\1\5\0\5\4\2\6\7\2\7\3\0\4\6\0\6\2\1\3\7\1\7\5' >> cube.bin
cat > cube.gltf << 'GLTF'
{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
 "materials": [{"normalTexture": {"index": 0}, "emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1],
                "pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}, "metallicFactor": 0.5}}],
 "textures": [{"source": 0}], "images": [{"uri": "chequered.png"}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
               {"bufferView": 1, "componentType": 5126, "count": 8, "type": "VEC2"},
               {"bufferView": 2, "componentType": 5121, "count": 36, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 64},
                 {"buffer": 0, "byteOffset": 160, "byteLength": 36}],
 "buffers": [{"uri": "cube.bin", "byteLength": 196}]}
GLTF
shown() { for f in "$@"; do echo "$f: $(grep -ao '"attributes":{[^}]*}' "$f" | sort -u) $(grep -ao '"materials":.*}\],"buffers"' "$f")"; done; }
options=(cube.gltf --resolution 60 --levels 1 -q)

bplod "${options[@]}" --appearance full -o full | cut -f 1
bplod "${options[@]}" --appearance full -o full1 -j 1 --memory 300M > list
same full full1
shown full/cube_LOD0.glb
bplod "${options[@]}" -o plain > list
shown plain/cube_LOD0.glb
[ "$(bpinfo full/cube_LOD0.glb | checksum)" = "$(bpinfo plain/cube_LOD0.glb | checksum)" ] && echo "the same triangles"
bpcheck cube.gltf full/cube_LOD0.glb | tail -1

# Tiles and leaves.
tiles=(cube.gltf --voxel 0.01 --tile 64 --profile 3dtiles --appearance full --leaves scene -q)
bplod "${tiles[@]}" -o tiles --cache cache | cut -f 1
bplod "${tiles[@]}" -o again -j 1 > list
same tiles again
shown tiles/cube_LOD0/*.glb tiles/cube_leaves/*.glb | cut -d : -f 2- | sort -u
bpcheck cube.gltf tiles | tail -1

# A scene without materials has the normals of its faces.
write_octahedron ball.obj
bplod ball.obj --resolution 30 --faces 40 --levels 1 --appearance full -o ball -q | cut -f 1
shown ball/ball_LOD0.glb

# The same of MTL. Where map_Bump is not grey, it is a normal map; two images for roughness and metal would have to be mixed.
write_painted_cubes
cp chequered.png other.png
cat > cubes.mtl << 'MTL'
newmtl chequered
Kd 0 1 0
norm chequered.png
map_Pr chequered.png
map_Ke chequered.png
MTL
bplod part0.obj --resolution 30 --levels 1 --appearance full -o painted -q > list
shown painted/part0_LOD0.glb
sed -i 's/norm/map_Bump -bm 1/; s/map_Pr/map_Pm other.png\n&/' cubes.mtl
said 'bplod part0.obj --resolution 30 --levels 1 --appearance full -o mixed | cut -f 1'
shown mixed/part0_LOD0.glb

# A plain material with a normal map: no texel is smaller than the map's, and an image of one colour is small.
sed -i '/map_\|norm/d' cubes.mtl && echo 'norm chequered.png' >> cubes.mtl
bplod part0.obj --resolution 256 --levels 1 --appearance full -o mapped -q > list
shown mapped/part0_LOD0.glb
[ $(stat -c %s mapped/part0_LOD0.glb) -lt 12000 ] && echo "small"
