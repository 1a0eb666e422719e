# What bpcheck answers: text and exit status for proxies that hold and for those that do not.
write_cube inner.obj 1
sed 's/^v \(.*\) \(.*\) \(.*\)$/echo v $((\1 * 3 - 1)) $((\2 * 3 - 1)) $((\3 * 3 - 1))/e' inner.obj > outer.obj  # -1 to 2
try bpcheck inner.obj outer.obj
try bpcheck outer.obj
try bpcheck outer.obj inner.obj
try bpcheck inner.obj inner.obj
head -n -1 outer.obj > open.obj
try bpcheck inner.obj open.obj
try bpcheck inner.obj outer.obj --json
try bpcheck inner.obj outer.obj --image both.png  # of earlier versions
try bpcheck inner.obj outer.obj --examples 1
try bpcheck inner.obj outer.obj --no-distances

# What files say of their making tells what may be wrong with the question.
for mode in bounding fit inside; do (echo "# provenance: bpmesh 0.1.0 mode=$mode faces=12"; cat inner.obj) > $mode.obj; done
for files in 'bounding.obj inner.obj' 'inner.obj fit.obj' 'inner.obj inside.obj' '--inside inner.obj bounding.obj' '--inside inner.obj inside.obj' \
  'inner.obj bounding.obj' 'bounding.obj fit.obj' 'bounding.obj outer.obj' 'fit.obj'; do said "bpcheck $files | tail -1"; done
rm bounding.obj fit.obj inside.obj

# So does the hash of the scene that a proxy was made from. It is asked for where the proxy fails only.
bpvox inner.obj --resolution 20 | bpclose --scale 2vx | bpmesh --faces 12 -q -o made.ply
bplod inner.obj --resolution 20 --levels 1 --faces 12 --mode fit -q -o fit > list
bplod inner.obj outer.obj --resolution 20 --levels 1 --faces 12 --profile 3dtiles -q -o tiles > list
sed 's/^v 0 0 0/v -9 0 0/' inner.obj > changed.obj
for files in 'inner.obj made.ply' 'changed.obj made.ply' 'outer.obj made.ply' '--inside outer.obj made.ply' 'inner.obj fit/inner_LOD0.glb' 'outer.obj fit/inner_LOD0.glb' \
  'inner.obj outer.obj made.ply' 'inner.obj outer.obj tiles' 'changed.obj outer.obj tiles'; do said "bpcheck $files | tail -1"; done
rm -r made.ply fit tiles list changed.obj

# A file with levels (MSFT_lod): each is a proxy of its own, and all must hold.
# write_levels FILE SIZE...: a glTF whose levels are cubes from -SIZE to SIZE.
write_levels() {
  local file=$1 minus='\0\0\200\277' plus='\0\0\200\77' corner data= nodes= ids= i=0 size
  for corner in "$minus $minus $minus" "$plus $minus $minus" "$plus $plus $minus" "$minus $plus $minus" \
    "$minus $minus $plus" "$plus $minus $plus" "$plus $plus $plus" "$minus $plus $plus"; do data+=${corner// /}; done
  data+='\0\3\2\0\2\1\4\5\6\4\6\7\0\1\5\0\5\4\1\2\6\1\6\5\2\3\7\2\7\6\3\0\4\3\4\7'
  shift
  for size in "$@"; do
    [ $i = 0 ] || ids+=${ids:+,}$i
    nodes+=${nodes:+,}"{\"mesh\":0,\"scale\":[$size,$size,$size]@$i}"
    i=$((i + 1))
  done
  nodes=${nodes/@0/,\"extensions\":\{\"MSFT_lod\":\{\"ids\":[$ids]\}\}}
  cat > "$file" << GLTF
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[$(sed 's/@[0-9]*//g' <<< "$nodes")],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[-1,-1,-1],"max":[1,1,1]},{"bufferView":1,"componentType":5121,"count":36,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":36}],
"buffers":[{"byteLength":132,"uri":"data:application/octet-stream;base64,$(printf "$data" | base64 -w 0)"}]}
GLTF
}
write_levels levels.gltf 2 3 5
try bpcheck inner.obj levels.gltf | grep -v '^  '
write_levels levels.gltf 2 0.5 5
said 'bpcheck inner.obj levels.gltf | grep -v "^  "'
said 'bpcheck inner.obj levels.gltf --json --report levels.json | grep -E "^ ? ? ? ?.?.?\"(holds|levels)"'
sed -n '/counts/,/\]/p' levels.json
said 'bpcheck inner.obj - --format gltf < levels.gltf | tail -1'
files
