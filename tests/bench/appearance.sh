#!/usr/bin/env bash
# How much levels look like their scene, beside gltfpack's simplification (meshoptimizer) at the same triangles: PSNR and SSIM
# over 24 views, at the size at which the level would be shown: its error is a pixel there (at most 512 pixels).
# usage: [LEVELS=FACES,...] appearance.sh TOOLS OUT SCENE...      SCENE: OBJ or glTF with textures
# NODE_PATH: folder of the packages that tests/viewers/run.sh installs, and gltfpack.
set -euo pipefail
tools=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$2" && out=$(cd "$2" && pwd)
shift 2
gltfpack() { node "$NODE_PATH/gltfpack/cli.js" "$@"; }
echo "| scene | level | faces | bytes | pixels | PSNR | SSIM | gltfpack: faces | bytes | PSNR | SSIM | colours only: PSNR | SSIM |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
for scene in "$@"; do
  name=$(basename "${scene%.*}") work=$out/$(basename "${scene%.*}")
  rm -rf "$work" && mkdir -p "$work"
  cp "$(dirname "$scene")"/*.{png,jpg,jpeg} "$work"/ 2> /dev/null || true
  gltfpack -noq -kn -i "$scene" -o "$work/scene.glb" > /dev/null
  triangles=$("$tools/bpinfo" "$work/scene.glb" --json | python3 -c 'import json,sys; print(json.load(sys.stdin)["triangles"])')
  faces=()
  [ -z "${LEVELS:-}" ] || faces=(--faces "$LEVELS")
  "$tools/bplod" "$scene" "${faces[@]}" -o "$work/levels" --name level --report "$work/report.json" -q > /dev/null
  "$tools/bplod" "$scene" "${faces[@]}" -o "$work/colors" --name level --appearance color -q > /dev/null
  python3 -c '
import json, sys
report = json.load(open(sys.argv[1]))
for i, level in enumerate(report["counts"]["levels"]): print(i, level["faces"], level["error"])' "$work/report.json" |
  while read -r i count error; do
    diagonal=$("$tools/bpinfo" "$work/scene.glb" --json | python3 -c 'import json,math,sys; b=json.load(sys.stdin)["bounds"]; print(math.dist(b["min"],b["max"]))')
    pixels=$(python3 -c "print(int(max(48, min(512, $diagonal / $error))))")
    gltfpack -noq -sa -se 1 -si "$(python3 -c "print(min(1, $count / $triangles))")" -i "$scene" -o "$work/pack$i.glb" > /dev/null
    mapfile -t seen < <(node "$here/appearance.cjs" "$pixels" "$work/scene.glb" "$work/levels/level_LOD$i.glb" "$work/pack$i.glb" "$work/colors/level_LOD$i.glb")
    packed=$("$tools/bpinfo" "$work/pack$i.glb" --json | python3 -c 'import json,sys; print(json.load(sys.stdin)["triangles"])')
    cell() { echo "${1/ / | }"; }
    echo "| $name | $i | $count | $(stat -c %s "$work/levels/level_LOD$i.glb") | $pixels | $(cell "${seen[0]}") | $packed | $(stat -c %s "$work/pack$i.glb") | $(cell "${seen[1]}") | $(cell "${seen[2]}") |"
  done
done
