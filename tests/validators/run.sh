#!/usr/bin/env bash
# Second opinions on what bplod and bpmesh write: Khronos' validator, and glTF-Transform, whose decoder of
# EXT_meshopt_compression is not ours. They come from npm, pinned; without node or network there is nothing to run, and the
# test is skipped (77).
#   tests/validators/run.sh FOLDER      FOLDER keeps the installed packages; the tools are on PATH
set -euo pipefail
packages=(gltf-validator@2.0.0-dev.3.10 @gltf-transform/cli@4.5.1)
here=$(cd "$(dirname "$0")" && pwd)
skip() { echo "skipped: $1"; exit 77; }
command -v node > /dev/null && command -v npm > /dev/null || skip "node and npm are not installed"
mkdir -p "$1" && cd "$1"
if [ "$(cat installed 2> /dev/null)" != "${packages[*]}" ]; then
  [ -f package.json ] || echo '{"private": true}' > package.json
  timeout 300 npm install --no-audit --no-fund --loglevel=error "${packages[@]}" > npm.log 2>&1 || skip "npm cannot install ${packages[*]}: $(tail -1 npm.log)"
  echo "${packages[*]}" > installed
fi
export NODE_PATH=$PWD/node_modules PATH=$PWD/node_modules/.bin:$PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

bp-plant --triangles 20000 -o "$work/plant.ply"
cd "$work"
for up in y z; do
  bplod plant.ply --levels 3 --resolution 96 --up $up -o gltf-$up > /dev/null
  bplod plant.ply --levels 3 --resolution 96 --up $up --profile 3dtiles -o tiles-$up > /dev/null
  bpvox plant.ply --resolution 96 --up $up | bpclose --scale 2% | bpmesh --faces 400 -o gltf-$up/bpmesh.glb
done
# Colours and normals.
printf 'newmtl red\nKd 1 0 0\n' > red.mtl
{ printf 'mtllib red.mtl\nusemtl red\nv 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nv 0 0 9\nv 9 0 9\nv 9 9 9\nv 0 9 9\n'
  printf 'f %s\n' '1 4 3 2' '5 6 7 8' '1 2 6 5' '2 3 7 6' '3 4 8 7' '4 1 5 8'; } > red.obj
for up in y z; do
  bplod red.obj --levels 2 --resolution 64 --mode fit --up $up -o gltf-red-$up > /dev/null
  bplod red.obj --levels 2 --resolution 64 --mode fit --up $up --profile 3dtiles -o tiles-red-$up > /dev/null
done
# Textures.
"$here/../../samples/town.py" town 4 > /dev/null
bplod town/town.obj --levels 2 --resolution 64 -o gltf-town > /dev/null
bplod town/town.obj --levels 1 --resolution 64 --appearance full -o gltf-full > /dev/null
bplod town/town.obj --levels 3 --resolution 96 --tile 64 --profile 3dtiles -o tiles-town > /dev/null
bplod town/town.obj --levels 2 --resolution 96 --tile 64 --profile 3dtiles --appearance full --leaves scene -o tiles-full > /dev/null
cp tiles-town/town_LOD0/*.glb tiles-town/ 2> /dev/null || true
# Morph targets and an animation, of a scene with normals and of one in two places.
awk 'BEGIN { for (i = 0; i < 8; ++i) print "v", (i % 2 ? 99 : -99), (int(i / 2) % 2 ? 99 : -99), (i > 3 ? 99 : -99)
  split("1 3 4 2 5 6 8 7 1 2 6 5 3 7 8 4 1 5 7 3 2 4 8 6", v); for (i = 1; i < 25; i += 4) print "f", v[i], v[i+1], v[i+2], v[i+3] }' > cage.obj
awk '$1 == "v" && $3 > 0 { $2 += 50 } { print }' cage.obj > bent.obj
for level in gltf-y/bpmesh gltf-red-y/red_LOD0; do
  bpdeform bind $level.glb cage.obj -o moving.bpw --overwrite
  bpdeform apply moving.bpw cage.obj bent.obj --animate 1 -o ${level}_moving.glb
done
node "$here/validate.cjs" gltf-*/*.glb tiles-*/*.glb tiles-full/*/*.glb

# The same triangles, bit for bit, by another decoder.
for tile in tiles-*/*.glb; do
  gltf-transform cp "$tile" decoded.glb > /dev/null
  [ "$(bpinfo decoded.glb | grep checksum)" = "$(bpinfo "$tile" | grep checksum)" ] || { echo "$tile: decodes to other triangles"; exit 1; }
  rm decoded.glb
done
for up in y z; do bpcheck plant.ply tiles-$up/tileset.json; done
echo "validated $(ls gltf-*/*.glb tiles-*/*.glb | wc -l) files"
