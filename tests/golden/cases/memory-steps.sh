# A refusal names a --memory for the whole run: the steps before, of and after the one that is refused. So the second run ends.
named() {
  echo "\$ $*"
  rm -rf o.glb o.*.glb lod
  "$@" -q -j 1 --memory 64M 2> said > out
  echo "= $?"
  sed 's/[0-9.]* MiB/N MiB/g; s/[0-9]* triangles/N triangles/; s/with a halo of [0-9]*/with a halo of N/; s/^/| /' said
  least=$(grep -o 'to at least [0-9]*' said | grep -o '[0-9]*')
  "$@" -q -j 1 --memory "${least}M" --report r.json 2> said > out || { cat said && return; }
  peak=$(grep -o '"peak_memory_bytes": [0-9]*' r.json | grep -o '[0-9]*$')
  [ "$peak" -le $((least << 20)) ] && echo "done within what was named" || echo "$peak bytes of ${least}M"
}
bp-plant --triangles 60000 -o plant.ply > /dev/null
bpvox plant.ply --resolution 500 -q -o solid.bp
bpvox plant.ply --resolution 500 --fill inside -q -o inside.bp
bpclose solid.bp --scale 1% -q -o closed.bp
named bpmesh closed.bp --faces 20000 --enclose input -o o.glb
named bpmesh closed.bp --faces 5000 --enclose scene -o o.glb
named bpmesh closed.bp --faces 5000 --enclose plant.ply -o o.glb
named bpmesh closed.bp --faces 20000,500 --enclose closing -o o.glb
named bpmesh closed.bp --error 2% -o o.glb
named bpmesh closed.bp --mode fit --faces 3000 -o o.glb
named bpmesh inside.bp --mode inside --faces 1000 -o o.glb
named bplod plant.ply --resolution 400 --faces 5000 -o lod
named bplod plant.ply --resolution 400 --faces 5000 --levels 1 --enclose input -o lod
named bplod plant.ply --resolution 400 --mode fit --faces 2000 --levels 1 -o lod
named bplod plant.ply --resolution 400 --profile collision -o lod
named bplod plant.ply --resolution 700 --profile occluder --faces 300 --scale 0 -o lod
# Of a tileset the scene, the closings, the tiles, the leaves and the levels in one mesh come one after the other.
named bplod plant.ply --resolution 400 --profile 3dtiles -o lod
named bplod plant.ply --resolution 400 --profile 3dtiles --enclose input --leaves scene -o lod
named bplod plant.ply --resolution 400 --profile 3dtiles --leaves scene --tile 128 -o lod
rm -rf plant.ply solid.bp inside.bp closed.bp o.glb o.*.glb lod said out r.json
files
