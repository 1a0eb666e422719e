# glTF and tilesets that other programs read in another way: nothing is proven of them. Each line of the tables: the answer that is right, and
# the file. A cube is to lie in each proxy, and each scene in the box.
write_cube cube.obj 1
awk '/^v/ { print "v", $2 * 3 - 1, $3 * 3 - 1, $4 * 3 - 1; next } { print }' cube.obj > around.obj
cp "$BP_ROOT"/tests/data/bugs/readings_gltf/* "$BP_ROOT"/tests/data/bugs/readings_tiles/* .
while read -r right file; do answer "$right" "$file" "$file" around.obj; done << 'TABLE'
refuted inst_custom.glb
refused inst_none.glb
undecided inst_notreq.glb
undecided joints1.glb
refused jointsnorm.glb
refused draco_strip.glb
refused draco_shared.glb
refuted b64_u.gltf
refused b64_n.gltf
refused b64_url.gltf
refused oddchunk.glb
refused mo_nostride.glb
refused idxstride.glb
refused ibmstride.glb
refused morph_short.glb
refused morph_empty.glb
undecided skew.glb
undecided rootchild.glb
refused u32norm.glb
refused ts_outer.json
refused ts_unk.json
refused ts_zeroerr.json
TABLE

# A tileset whose own error is below the size of the scene once a viewer scales it by the root.
answer refuted ps.json cube.obj ps.json

# A rotation that is not quite of length 1, far from its node: some programs do not make it so.
answer undecided rot.glb rot.glb rot_around.obj
