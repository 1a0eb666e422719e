#!/usr/bin/env bash
# Makes the pictures of docs/gallery.md and prints the numbers beside them.
# usage: gallery.sh BUILD_DIR OUT_DIR
set -euo pipefail
build=$(cd "$1" && pwd)
mkdir -p "$2" && cd "$2"
export PATH="$build/tools:$build/samples:$PATH"

# mesh INPUT OPTION...: its report as lines of the tables.
mesh() {
  bpmesh "$@" --measure --overwrite -q --report report.json
  python3 - <<'P'
import json
counts = json.load(open("report.json"))["counts"]
for i, level in enumerate(counts["levels"]):
    show = lambda k: "%.2f (%.3g)" % (level["distance"][k]["mean"], level["distance"][k]["at_most"])
    ratio = level["volume"] / counts["volume_of_voxels"]
    print(f'| {i} | {level["faces"]} | {ratio:.3f} | {show("proxy_to_enclosed")} | {show("enclosed_to_proxy")} |')
P
}
draw() {
  local out=$1 size=$2
  shift 2
  bpinfo "$@" --image "$out" --image-size "$size" --overwrite >/dev/null
}

bp-plant --triangles 200000 -o plant.ply --overwrite
bpvox plant.ply --resolution 192 -q | bpclose --scale 2% -q -o closed.bpv --overwrite
echo "proxy"
mesh closed.bpv --enclose closing --faces 1000 -o proxy.glb
draw gallery-stages.png 400 plant.ply closed.bpv proxy.glb
echo "levels"
mesh closed.bpv --enclose closing --faces 2000,600,200 -o lod.glb
draw gallery-levels.png 340 lod.0.glb lod.1.glb lod.2.glb
echo "inside"
bpvox plant.ply --resolution 192 --fill inside -q | bpclose --inner --scale 1% -q -o opened.bpv --overwrite
mesh opened.bpv --mode inside --faces 300 -o inside.glb
draw gallery-inside.png 400 plant.ply inside.glb
echo "fit"
mesh closed.bpv --mode fit --faces 1000 -o fit.glb
draw gallery-fit.png 400 closed.bpv fit.glb
echo "quads"
mesh closed.bpv --enclose closing --faces 700 --quads -o cage.obj
grep -c '^f [^ ]* [^ ]* [^ ]* ' cage.obj | sed 's/$/ quads/'
draw gallery-quads.png 400 cage.obj
