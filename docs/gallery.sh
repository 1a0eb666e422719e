#!/usr/bin/env bash
# Makes the pictures of docs/gallery.md and docs/guides, and prints the numbers beside those of the gallery.
# usage: [MODELS=FOLDER] gallery.sh BUILD_DIR OUT_DIR
# MODELS: a folder as docs/gallery.md describes it, for the pictures of other people's models; assimp-utils reads their houses.
# The picture of CesiumJS needs the packages that tests/viewers/run.sh installs: NODE_PATH names their folder.
set -euo pipefail
build=$(cd "$1" && pwd)
root=$(cd "$(dirname "$0")/.." && pwd)
[ -z "${MODELS:-}" ] || MODELS=$(cd "$MODELS" && pwd)
mkdir -p "$2" && cd "$2"
[ -e .gallery ] || [ -z "$(ls -A)" ] || { echo "gallery.sh: $2: is not empty, and files there are replaced; give an empty folder" >&2 && exit 2; }
touch .gallery
export PATH="$build/tools:$build/samples:$PATH"

# mesh OUT QUESTION INPUT OPTION...: lines of the tables: level, faces, volume over that of the voxels, and of QUESTION "scene"
# the distance from the proxy to the scene, mean (largest of the samples); "none" asks for no distances.
mesh() {
  local out=$1 question=$2
  shift 2
  bpmesh "$@" -o "$out" --overwrite -q --report report.json
  python3 - "$out" "$question" <<'P'
import json, subprocess, sys
report, out = json.load(open("report.json")), sys.argv[1]
levels = report["counts"]["levels"]
for i, level in enumerate(levels):
    name = out if len(levels) == 1 else out.replace(".", f".{i}.")
    line = f'| {i} | {level["faces"]} | {level["volume"] / report["counts"]["volume_of_voxels"]:.3f} |'
    if sys.argv[2] == "scene":
        check = subprocess.run(["bpcheck", "plant.ply", name, "--json"], capture_output=True, text=True).stdout
        distance = json.loads(check)["measures"]["proxy_to_scene"]
        line += " %.2f (%.3g) |" % (distance["mean"], distance["max"])
    if "quads" in level:
        line += " quads: " + json.dumps(level["quads"])
    print(line)
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
mesh proxy.glb scene closed.bpv --faces 1000
draw gallery-stages.png 400 plant.ply closed.bpv proxy.glb
bpvox plant.ply --resolution 256 -q | bpclose --scale 2% -q | bpmesh --faces 3000 -q -o plant.glb --overwrite
draw plant.png 440 plant.ply plant.glb
echo "levels"
mesh lod.glb scene closed.bpv --faces 2000,600,200
draw gallery-levels.png 340 lod.0.glb lod.1.glb lod.2.glb
echo "inside"
bpvox plant.ply --resolution 192 --fill inside -q | bpclose --scale 1% -q -o opened.bpv --overwrite
mesh inside.glb none opened.bpv --mode inside --faces 300
draw gallery-inside.png 400 plant.ply inside.glb
echo "fit"
mesh fit.glb scene closed.bpv --mode fit --faces 1000
draw gallery-fit.png 400 closed.bpv fit.glb
echo "quads"
mesh cage.obj scene closed.bpv --faces 700 --quads
grep -c '^f [^ ]* [^ ]* [^ ]* ' cage.obj | sed 's/$/ quads/'
draw gallery-quads.png 400 cage.obj

"$root/samples/scenes.py" . > /dev/null
rm -rf figure-cage truck-collision house-occluder figure-lod city-tiles town-lod town-tiles night levels
bplod truck.obj --profile collision --faces 500 -q -o truck-collision > /dev/null
draw guide-collision.png 360 truck.obj truck-collision/truck_godot.glb truck-collision/truck_unreal.glb
bplod house.obj --profile occluder -q -o house-occluder > /dev/null
draw guide-occluder.png 400 house.obj house-occluder/house_occluder.glb
mkdir -p occluder
draw occluder/leaks.png 640 house.obj --leaks -q
bpvox figure.obj --resolution 256 -q | bpclose --scale 2% -q | bpmesh --faces 1000 --quads -q -o figure_pairs.obj --overwrite
bplod figure.obj --profile cage -q -o figure-cage > /dev/null
cp figure-cage/figure_cage.obj .
draw guide-cage.png 400 figure.obj figure_cage.obj
draw guide-cage-quads.png 400 figure_pairs.obj figure_cage.obj
awk '/^v / { y = $3 > 0.9 ? $3 - 0.9 : 0; c = cos(0.55 * y); s = sin(0.55 * y)  # leans to the side, above the hips
  $0 = sprintf("v %.6f %.6f %s", $2 * c + 0.8 * y * s, $3 - $2 * s - 0.3 * y * (1 - c), $4) } { print }' figure_cage.obj > posed_cage.obj
bpdeform bind figure.obj figure_cage.obj -o figure.bpw --overwrite
bpdeform apply figure.bpw posed_cage.obj -o posed.obj --overwrite
draw guide-cage-pose.png 340 figure.obj figure_cage.obj posed_cage.obj posed.obj
bpvox figure.obj --resolution 200 -q | bpclose --scale 4% -q | bpmesh --faces 300 --enclose closing -q -o coarse.obj --overwrite
"$root/samples/softbody.py" figure.obj coarse.obj soft 42
draw guide-softbody.png 280 soft/scene.{00,13,17,24,30,36}.obj --zoom 1.2
echo "{\"base\": \"4%\", \"rules\": [{\"at\": [$(bpinfo figure.obj --pick 355,125)], \"radius\": \"14%\", \"scale\": \"0.5%\"}]}" > head.json
bpvox figure.obj --resolution 256 -q | bpscale head.json -q | bpclose -q -o closed.bpv --overwrite
bpmesh closed.bpv --faces 800 -q -o finer.glb --overwrite
bpvox figure.obj --resolution 256 -q | bpclose --scale 4% -q | bpmesh --faces 800 -q -o one-scale.glb --overwrite
draw guide-scale.png 340 figure.obj closed.bpv finer.glb one-scale.glb
"$root/samples/lessons" lessons > /dev/null
for lesson in brush pinch; do cp "lessons/$lesson.png" "lesson-$lesson.png"; done
echo '{"base": "3%", "orientation": "auto"}' > office.json
bpvox office.obj --resolution 384 -q -o office.bpv --overwrite
bpscale office.json office.bpv -q | bpclose -q -o office-auto.bpv --overwrite
bpclose office.bpv --scale 3% -q -o office-axes.bpv --overwrite
draw guide-office.png 400 office.obj office-axes.bpv office-auto.bpv
echo '{"base": "3%", "rules": [{"gap": 10}]}' > streets.json
bpvox city.obj --up z --resolution 384 -q -o city.bpv --overwrite
bpscale streets.json city.bpv -q | bpclose -q -o streets.bpv --overwrite
bpmesh streets.bpv --faces 4000 -q -o streets.glb --overwrite
bpclose city.bpv --scale 3% -q | bpmesh --faces 4000 -q -o no-streets.glb --overwrite
draw guide-streets.png 400 no-streets.glb streets.bpv streets.glb --view 30,45
bplod figure.obj --faces 4000,1000,250 -q -o figure-lod > /dev/null
draw guide-levels.png 280 figure.obj figure-lod/figure_LOD{0,1,2}.glb
bplod city.obj --up z --profile 3dtiles -q -o city-tiles > /dev/null
"$root/samples/town.py" town 64 > /dev/null
bplod town/town.obj --faces 2000 -q -o town-2000 > /dev/null
draw gallery-textures.png 440 town/town.obj town-2000/town_LOD0.glb --zoom 1.4
bplod truck.obj --appearance texture --faces 1500 -q -o truck-textured > /dev/null
draw gallery-colours.png 440 truck.obj truck-textured/truck_LOD0.glb --zoom 1.2

# textured OUT SIZE UP SCENE FACES PICTURE_OPTION...: a scene beside a level of it
textured() {
  local out=$1 size=$2 up=$3 scene=$4 faces=$5
  shift 5
  bplod "$scene" --up "$up" --faces "$faces" --levels 1 -q -o "$out-level" --name level --overwrite > /dev/null
  draw "$out" "$size" "$scene" --up "$up" "$out-level"/level_LOD0.glb "$@"
}
# only NAME IN.glb OUT.glb: the nodes with this name
only() {
  python3 - "$@" << 'P'
import json, struct, sys
data = open(sys.argv[2], "rb").read()
size = struct.unpack_from("<I", data, 12)[0]
doc, rest = json.loads(data[20:20 + size]), data[20 + size:]
doc["scenes"][0]["nodes"] = [i for i, node in enumerate(doc["nodes"]) if node.get("name") == sys.argv[1]]
for node in doc["nodes"]: node.pop("children", None)
text = json.dumps(doc).encode()
text += b" " * (-len(text) % 4)
open(sys.argv[3], "wb").write(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest)
P
}
if [ -n "${MODELS:-}" ]; then
  morse=$MODELS/usr/share/morse/data
  assimp export "$morse/environments/land-1/rosace_1.blend" land.glb -f glb2 > /dev/null
  mkdir -p models
  only City.1 land.glb houses.glb
  textured models/houses.png 380 z houses.glb 800
  textured models/vehicle.png 340 z "$morse/robots/hummer.blend" 1200
  textured models/person.png 400 z "$morse/robots/victim.blend" 1000 --zoom 1.1 --view 60,10
  textured models/avocado.png 400 y "$MODELS/Avocado/glTF/Avocado.gltf" 400
fi
if [ -n "${NODE_PATH:-}" ]; then
  node "$root/tests/viewers/shot.cjs" cesium city-tiles/tileset.json guide-tileset.png 'width=520&radii=1.3&pixels=4' > /dev/null
  "$root/tests/viewers/run.sh" viewers > /dev/null && cp viewers/all.png guide-viewers.png
  "$root/samples/town.py" town-view 4000 > /dev/null
  bplod town-view/town.obj --profile 3dtiles --mode visual --faces 16384 -q -o town-tiles > /dev/null
  node "$root/tests/viewers/shot.cjs" cesium town-tiles/tileset.json guide-visual-tileset.png 'width=520&metres=220' > /dev/null
  bplod town/town.obj --faces 6000,1000,300 -q -o town-lod > /dev/null
  node "$root/tests/viewers/shot.cjs" three town-lod/town_LOD0.glb guide-textures.png 'width=420&radii=0.33' > /dev/null
fi
if command -v blender > /dev/null; then
  rm -rf blender-user && mkdir -p blender-user/addons
  "$root/tools/blender/pack.py" addon.zip > /dev/null
  python3 -m zipfile -e addon.zip blender-user/addons
  export BLENDER_USER_SCRIPTS=$PWD/blender-user
  "$root/samples/town.py" town-16/town 16 > /dev/null
  cp truck.* figure.* town-16
  blender -b --factory-startup --python-exit-code 1 -P "$root/docs/blender_gallery.py" -- town-16 blender > blender.log
  xvfb-run -a -s '-screen 0 1120x720x24' blender --factory-startup --enable-event-simulate -p 0 0 1120 720 -P "$root/docs/blender_gallery.py" -- town-16 blender > blender.log
fi
mkdir night && cp house.obj house.mtl truck.obj truck.mtl night
"$root/samples/nightly" night levels --faces 1000,200
draw guide-nightly.png 300 levels/house.obj/house_LOD{0,1}.glb levels/truck.obj/truck_LOD{0,1}.glb
