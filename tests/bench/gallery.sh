#!/usr/bin/env bash
# Makes the pictures of docs/gallery.md and docs/guides, and prints the numbers beside those of the gallery.
# usage: gallery.sh BUILD_DIR OUT_DIR
# The picture of CesiumJS needs the packages that tests/viewers/run.sh installs: NODE_PATH names their folder.
set -euo pipefail
build=$(cd "$1" && pwd)
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$2" && cd "$2"
export PATH="$build/tools:$build/samples:$PATH"

# mesh INPUT OPTION...: its report as lines of the tables. A bound on the distance that nothing reaches (--error 100%) has the
# distances measured.
mesh() {
  bpmesh "$@" --overwrite -q --report report.json
  python3 - <<'P'
import json
counts = json.load(open("report.json"))["counts"]
for i, level in enumerate(counts["levels"]):
    far = level.get("distance")
    show = lambda k: "%.2f (%.3g)" % (far[k]["mean"], far[k]["at_most"]) if far else "-"
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
mesh closed.bpv --enclose closing --faces 1000 --error 100% -o proxy.glb
draw gallery-stages.png 400 plant.ply closed.bpv proxy.glb
bpvox plant.ply --resolution 256 -q | bpclose --scale 2% -q | bpmesh --faces 3000 -q -o plant.glb --overwrite
draw plant.png 440 plant.ply plant.glb
echo "levels"
mesh closed.bpv --enclose closing --faces 2000,600,200 --error 100% -o lod.glb
draw gallery-levels.png 340 lod.0.glb lod.1.glb lod.2.glb
echo "inside"
bpvox plant.ply --resolution 192 --fill inside -q | bpclose --inner --scale 1% -q -o opened.bpv --overwrite
mesh opened.bpv --mode inside --faces 300 -o inside.glb
draw gallery-inside.png 400 plant.ply inside.glb
echo "fit"
mesh closed.bpv --mode fit --faces 1000 -o fit.glb
draw gallery-fit.png 400 closed.bpv fit.glb
echo "quads"
mesh closed.bpv --enclose closing --faces 700 --error 100% --quads -o cage.obj
grep -c '^f [^ ]* [^ ]* [^ ]* ' cage.obj | sed 's/$/ quads/'
draw gallery-quads.png 400 cage.obj

"$root/samples/scenes.py" . > /dev/null
rm -rf truck-collision house-occluder figure-lod city-tiles night levels
bplod truck.obj --profile collision --faces 500 -q -o truck-collision > /dev/null
draw guide-collision.png 360 truck.obj truck-collision/truck_godot.glb truck-collision/truck_unreal.glb
bplod house.obj --profile occluder -q -o house-occluder > /dev/null
draw guide-occluder.png 400 house.obj house-occluder/house_occluder.glb
bpvox figure.obj --resolution 256 -q | bpclose --scale 2% -q | bpmesh --faces 700 --quads -q -o figure_cage.obj --overwrite
draw guide-cage.png 400 figure.obj figure_cage.obj
bplod figure.obj --faces 4000,1000,250 -q -o figure-lod > /dev/null
draw guide-levels.png 280 figure.obj figure-lod/figure_LOD{0,1,2}.glb
bplod city.obj --up z --profile 3dtiles -q -o city-tiles > /dev/null
if [ -n "${NODE_PATH:-}" ]; then
  node "$root/tests/viewers/shot.cjs" cesium city-tiles/tileset.json guide-tileset.png 'width=520&radii=1.3&pixels=4' > /dev/null
fi
mkdir night && cp house.obj house.mtl truck.obj truck.mtl night
"$root/samples/nightly" night levels --faces 1000,200
draw guide-nightly.png 300 levels/house.obj/house_LOD{0,1}.glb levels/truck.obj/truck_LOD{0,1}.glb
