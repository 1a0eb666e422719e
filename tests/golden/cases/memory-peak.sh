# What a run really takes is no more than --memory, with every profile and a cache; and a run that needs more says so
# before it takes it.
bp-plant --triangles 20000 -o plant.ply > said
within() {
  "$@" -j 1 --memory 96M -q --overwrite -o x --report r.json > said || cat said
  peak=$(grep -o '"peak_memory_bytes": [0-9]*' r.json | grep -o '[0-9]*$')
  [ "$peak" -le $((96 << 20)) ] && echo "within --memory" || echo "$*: $peak bytes"
  rm -rf r.json
}
within bplod plant.ply --resolution 200 --levels 2
within bplod plant.ply --resolution 200 --profile collision --faces 2000
within bplod plant.ply --resolution 200 --levels 3 --profile 3dtiles --tile 64 --cache c
within bplod plant.ply --resolution 200 --levels 3 --profile 3dtiles --tile 64 --cache c
(ulimit -v 400000; try bplod plant.ply --resolution 1500 --levels 1 -j 1 --memory 64M -o y | sed 's/[0-9.]* MiB/N MiB/g')
