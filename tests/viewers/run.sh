#!/usr/bin/env bash
# What people see: levels and tiles in three.js and CesiumJS, in headless Chromium, and in Blender, if it is there. A lit picture has many grey values; a
# file without normals or material is a flat silhouette, or black. Packages come from npm, pinned; without Chromium, node
# or network the test is skipped (77).
#   tests/viewers/run.sh FOLDER      FOLDER keeps the installed packages and the pictures; the tools are on PATH
set -euo pipefail
packages=(three@0.187.0 cesium@1.140.0 playwright-core@1.65.1)
here=$(cd "$(dirname "$0")" && pwd)
skip() { echo "skipped: $1"; exit 77; }
command -v chromium > /dev/null || skip "chromium is not installed"
command -v node > /dev/null && command -v npm > /dev/null || skip "node and npm are not installed"
mkdir -p "$1" && cd "$1"
if [ "$(cat installed 2> /dev/null)" != "${packages[*]}" ]; then
  [ -f package.json ] || echo '{"private": true}' > package.json
  timeout 300 npm install --no-audit --no-fund --loglevel=error "${packages[@]}" > npm.log 2>&1 || skip "npm cannot install ${packages[*]}: $(tail -1 npm.log)"
  echo "${packages[*]}" > installed
fi
export NODE_PATH=$PWD/node_modules
rm -rf data
bp-plant --triangles 100000 -o plant.ply --overwrite > /dev/null
mkdir -p data
bplod plant.ply --faces 2000 --resolution 160 -o data/plant > /dev/null
bplod plant.ply --levels 3 --resolution 192 --tile 64 --profile 3dtiles -o data/plant-tiles > /dev/null
bpvox plant.ply --resolution 128 | bpclose --scale 1% | bpmesh --faces 1000 -o data/bpmesh.glb
"$here/../../samples/town.py" town 16 > /dev/null
bplod town/town.obj --faces 3000 --resolution 160 -o data/town > /dev/null

bplod town/town.obj --resolution 256 --tile 64 --profile 3dtiles --leaves scene -o data/leaves > /dev/null
"$here/../../samples/scenes.py" scenes > /dev/null
bplod scenes/figure.obj --faces 1000 --levels 1 --resolution 160 --appearance full -o data/figure > /dev/null
bplod scenes/truck.obj --faces 3000 --levels 1 --resolution 160 -o data/truck > /dev/null
bplod scenes/city.obj --up z --faces 4000 --levels 1 --appearance texture -o data/city > /dev/null
bplod scenes/engine.obj --faces 3000 --levels 1 -o data/engine > /dev/null
bplod scenes/city.obj --up z --profile 3dtiles --appearance texture -o data/city-tiles > /dev/null
bplod scenes/city.obj --up z --profile 3dtiles --mode visual --faces 5000 -o data/city-view > /dev/null
bplod scenes/city.obj --up z --profile 3dtiles --place 4.36,52.01,43 -o data/globe-tiles > /dev/null
bplod scenes/figure.obj --resolution 192 --profile 3dtiles -o data/figure-tiles > /dev/null
bplod scenes/engine.obj --profile 3dtiles -o data/engine-tiles > /dev/null

failed=0
# picture VIEWER FILE NAME [QUERY]
picture() {
  local greys
  if [ "$1" = blender ]; then
    command -v blender > /dev/null || { echo "$3: blender is not installed"; return; }
    greys=$(blender -b --factory-startup --python "$here/blender.py" -- "$2" "$PWD/$3.png" 2> /dev/null | sed -n 's/^greys //p')
  else
    greys=$(node "$here/shot.cjs" "$1" "$2" "$3.png" "${4:-}")
  fi
  echo "$3: $greys grey values"
  [ "${greys:-0}" -ge 20 ] || failed=1
}
picture three data/bpmesh.glb three-bpmesh
picture cesium data/leaves/tileset.json cesium-leaves
picture cesium data/globe-tiles/tileset.json cesium-globe placed=1
picture cesium data/city-view/tileset.json cesium-view
for scene in plant town figure truck city engine; do
  picture three data/$scene/${scene}_LOD0.glb three-$scene radii=0.75
  picture blender data/$scene/${scene}_LOD0.glb blender-$scene
done
shown=()
for viewer in three cesium blender; do
  for scene in city plant engine figure; do
    [ $viewer != cesium ] || picture cesium data/$scene-tiles/tileset.json cesium-$scene 'radii=2&pixels=4'
    [ ! -f $viewer-$scene.png ] || shown+=($viewer-$scene.png)
  done
done
node "$here/grid.cjs" 4 320 all.png "${shown[@]}" # one row for each viewer

# A mesh that is taken without its node has the size and the place of the level, turned to y up; far from the origin, relative to a translation.
bplod scenes/truck.obj --profile collision --resolution 160 -o data/body > /dev/null
for file in truck/truck_LOD0 city/city_LOD0 body/truck_unity body/truck_unreal; do
  cp data/$file.glb data/alone.glb
  node "$here/shot.cjs" three data/alone.glb alone.png alone=1 > alone
  bpinfo data/alone.glb --json > alone.json
  python3 - $file << 'P' || failed=1
import json, sys
seen, told = [float(x) for x in open("alone").read().split()[1:]], json.load(open("alone.json"))
low, high = told["bounds"]["min"], told["bounds"]["max"]
if sys.argv[1].startswith("city"):  # z up
    low, high = [low[0], low[2], -high[1]], [high[0], high[2], -low[1]]
glb = open("data/alone.glb", "rb").read()
node = json.loads(glb[20:20 + int.from_bytes(glb[12:16], "little")])["nodes"][0]
moved = node.get("translation", [0, 0, 0])  # of a scene far from its origin, and nothing else
print("alone:", sys.argv[1], seen, "moved by", moved)
sys.exit("scale" in node or "matrix" in node or seen != [b - m for b, m in zip(low + high, moved + moved)])
P
done

# An animated scene: at the time of a cage three.js sees it where `apply` of that cage writes it.
awk 'BEGIN { for (i = 0; i < 8; ++i) print "v", (i % 2 ? 2 : -2), (int(i / 2) % 2 ? 4 : -1), (i > 3 ? 2 : -2)
  split("1 3 4 2 5 6 8 7 1 2 6 5 3 7 8 4 1 5 7 3 2 4 8 6", v); for (i = 1; i < 25; i += 4) print "f", v[i], v[i+1], v[i+2], v[i+3] }' > cage.obj
awk '$1 == "v" && $3 > 0 { $2 += 1.5; $4 *= 1.5 } { print }' cage.obj > bent.obj
bpdeform bind data/figure/figure_LOD0.glb cage.obj -o figure.bpw --overwrite
bpdeform apply figure.bpw cage.obj bent.obj cage.obj --animate 2 -o data/moving.glb --overwrite
bpdeform apply figure.bpw bent.obj -o data/bent.glb --overwrite
node "$here/shot.cjs" three data/moving.glb moving.png time=0.5 > moving
bpinfo data/bent.glb --json > bent.json
python3 - << 'P' || { echo "moving: not where it should be"; failed=1; }
import json, sys
seen, bounds = [float(x) for x in open("moving").read().split()[1:]], json.load(open("bent.json"))["bounds"]
print("moving:", seen)
sys.exit(len(seen) != 6 or max(abs(a - b) for a, b in zip(seen, bounds["min"] + bounds["max"])) > 1e-3)
P
exit $failed
