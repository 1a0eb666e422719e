# Contents of tiles for viewers without a decoder: plain glTF, as proven as the others.
write_painted_cubes
tiles=(part*.obj --name cubes --voxel 0.1 --tile 128 --profile 3dtiles --leaves scene -q --cache cache)
bplod "${tiles[@]}" -o packed > list
bplod "${tiles[@]}" --compression none -o plain --report plain.json > list
for d in packed plain; do
  for f in $d/*.glb $d/cubes_LOD0/*.glb $d/cubes_leaves/*.glb; do grep -ao '"extensionsRequired":[^]]*\]' "$f" || echo none; done | sort | uniq -c
  bpcheck part*.obj $d | tail -1
done
# Keys of the cache differ: nothing packed is taken for plain.
kept plain.json
bplod "${tiles[@]}" --tile-compression none -o again > list
same plain again
grep -o '"compression": "[a-z]*"' plain.json
# Levels are plain, unless they are to be small; their triangles are the same, and as proven.
for how in none meshopt; do bplod part*.obj --name cubes --faces 300,60 -q -o "levels-$how" --compression "$how" > list; done
for f in cubes.glb cubes_LOD0.glb; do
  for how in none meshopt; do bpinfo "levels-$how/$f" --json | tail -n +3 > "$how.info"; done
  cmp none.info meshopt.info
  echo "$f: $(grep -ao '"extensionsRequired":[^]]*\]' "levels-meshopt/$f")"
  bpcheck part*.obj "levels-meshopt/$f" -q | tail -1
done
try bplod part0.obj -o x.obj --compression meshopt
try bplod part0.obj -o x --profile occluder --compression meshopt
