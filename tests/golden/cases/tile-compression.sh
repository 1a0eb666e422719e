# Contents of tiles for viewers without a decoder: plain glTF, as proven as the others.
write_painted_cubes
tiles=(part*.obj --name cubes --voxel 0.1 --tile 128 --profile 3dtiles --leaves scene -q --cache cache)
bplod "${tiles[@]}" -o packed > list
bplod "${tiles[@]}" --tile-compression none -o plain --report plain.json > list
for d in packed plain; do
  for f in $d/*.glb $d/cubes_LOD0/*.glb $d/cubes_leaves/*.glb; do grep -ao '"extensionsRequired":[^]]*\]' "$f" || echo none; done | sort | uniq -c
  bpcheck part*.obj $d | tail -1
done
# Keys of the cache differ: nothing packed is taken for plain.
kept plain.json
bplod "${tiles[@]}" --tile-compression none -o again > list
same plain again
grep -o '"tile_compression": "[a-z]*"' plain.json
try bplod part0.obj -o x --tile-compression none
