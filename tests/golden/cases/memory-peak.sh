# What a run really takes is no more than --memory, with every profile and a cache; and a run that needs more says so
# before it takes it.
bp-plant --triangles 20000 -o plant.ply > said
limit=96
within() {
  "$@" -j 1 --memory ${limit}M -q --overwrite --report r.json > said || cat said
  peak=$(grep -o '"peak_memory_bytes": [0-9]*' r.json | grep -o '[0-9]*$')
  [ "$peak" -le $((limit << 20)) ] && echo "within --memory" || echo "$*: $peak bytes"
  rm -rf r.json
}
within bplod plant.ply -o x --resolution 200 --levels 2
within bplod plant.ply -o x --resolution 200 --profile collision --faces 2000
within bplod plant.ply -o x --resolution 200 --levels 3 --profile 3dtiles --tile 64 --cache c
within bplod plant.ply -o x --resolution 200 --levels 3 --profile 3dtiles --tile 64 --cache c
# Tiles whose surfaces have many faces: a limit on distances would want each whole in memory.
within bplod plant.ply -o x --resolution 400 --levels 1 --profile 3dtiles --tile 192
# A later level of a chain, whose voxels have many faces though the levels have few: its surface is never whole either.
awk 'BEGIN {
  split("1 3 4 2 5 6 8 7 1 2 6 5 3 7 8 4 1 5 7 3 2 4 8 6", side, " ")
  for (i = 0; i < 1000; ++i) {
    for (k = 0; k < 8; ++k)
      print "v", 4 * (i % 10) + 0.75 + 2.25 * (k % 2), 4 * (int(i / 10) % 10) + 0.75 + 2.25 * (int(k / 2) % 2), 4 * int(i / 100) + 0.75 + 2.25 * int(k / 4)
    for (k = 1; k <= 24; k += 4)
      print "f", 8 * i + side[k], 8 * i + side[k + 1], 8 * i + side[k + 2], 8 * i + side[k + 3]
  }
}' > boxes.obj
bpvox boxes.obj --voxel 0.25 -q -o boxes.bpv
bpmesh boxes.bpv --faces 12000,11900 -j 1 -q -o roomy.ply
limit=104
within bpmesh boxes.bpv --faces 12000,11900 -o tight.ply
cmp roomy.1.ply tight.1.ply && echo "the same bytes"
try bpmesh boxes.bpv --faces 12000 -j 1 --memory 96M -q -o small.ply
try bpmesh boxes.bpv --faces 12000,11900 -j 1 --memory 96M -q -o small.ply --overwrite
(ulimit -v 400000; try bplod plant.ply --resolution 1500 --levels 1 -j 1 --memory 64M -q -o y | sed 's/[0-9.]* MiB/N MiB/g')
