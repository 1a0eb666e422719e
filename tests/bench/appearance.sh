#!/usr/bin/env bash
# How much levels look like their scene, beside gltfpack's simplification (meshoptimizer) at the same triangles or bytes: PSNR,
# SSIM and FLIP (0: the same) over 24 views, at the size at which the level would be shown: its error is a pixel there (at most 512 pixels).
# usage: [LEVELS=FACES,...] [MODE=fit] [APPEARANCE=full] [SAME=bytes] [PACKED=1] [UP=z] appearance.sh TOOLS OUT SCENE...      SCENE: OBJ or glTF
# UP: the axis of an OBJ that points up, which its file does not tell (default: y). Files keep its coordinates, and the views turn.
# PACKED: as for the web, contents of tiles of ours beside gltfpack -cc; else files that every reader takes, beside gltfpack -noq.
# NODE_PATH: folder of the packages that tests/viewers/run.sh installs, and gltfpack.
set -euo pipefail
tools=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$2" && out=$(cd "$2" && pwd)
shift 2
gltfpack() { node "$NODE_PATH/gltfpack/cli.js" "$@"; }
mode=(--mode "${MODE:-bounding}") kind=(-noq) profile=() looks=(--appearance "${APPEARANCE:-auto}")
[ -z "${PACKED:-}" ] || { kind=(-cc) profile=(--profile 3dtiles --tile 65536); }

# for_gltfpack SCENE FOLDER: prints the scene for gltfpack, which takes colours of MTL for linear light. We and three.js take them for sRGB, so
# it gets a copy with linear numbers.
for_gltfpack() {
  case $1 in *.obj) ;; *) echo "$1" && return ;; esac
  cp "$1" "$(dirname "$1")"/*.mtl "$2"/ 2> /dev/null || true
  python3 - "$2"/*.mtl << 'P'
import os, sys
linear = lambda s: s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4
for path in filter(os.path.exists, sys.argv[1:]):
    lines = open(path, errors="replace").read().split("\n")
    for i, line in enumerate(lines):
        words = line.split()
        if words[:1] == ["Kd"] and len(words) == 4: lines[i] = "Kd %.6f %.6f %.6f" % tuple(linear(float(x)) for x in words[1:])
    open(path, "w").write("\n".join(lines))
P
  echo "$2/$(basename "$1")"
}

# pack RATIO SCENE OUT [OPTION...]: leaves such a share of the triangles.
pack() { gltfpack "${kind[@]}" -se 1 -si "$1" -i "$2" -o "$3" "${@:4}" > /dev/null; }

# place CONTENT OUT: of a tile, at its place.
place() {
  python3 -c '
import json, struct, sys
data = open(sys.argv[1], "rb").read()
size = struct.unpack_from("<I", data, 12)[0]
doc = json.loads(data[20:20 + size])
doc["nodes"][0]["translation"] = doc["asset"]["extras"]["tile_origin"]
text = json.dumps(doc, separators=(",", ":")).encode()
text += b" " * (-len(text) % 4)
rest = data[20 + size:]
open(sys.argv[2], "wb").write(struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A) + text + rest)' "$@"
}

# pack_into BYTES SCENE OUT [OPTION...]: as many triangles as fit.
pack_into() {
  local low=-14 high=0 middle step
  for step in 1 2 3 4 5 6 7 8 9 10; do
    middle=$(python3 -c "print(($low + $high) / 2)")
    pack "$(python3 -c "import math; print(math.exp($middle))")" "${@:2}"
    if [ "$(stat -c %s "$3")" -gt "$1" ]; then high=$middle; else low=$middle; fi
  done
  pack "$(python3 -c "import math; print(math.exp($low))")" "${@:2}"
}

echo "| scene | level | faces | bytes | pixels | PSNR | SSIM | FLIP | gltfpack: faces | bytes | PSNR | SSIM | FLIP | colours only: PSNR | SSIM | FLIP |"
echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
for scene in "$@"; do
  name=$(basename "${scene%.*}") work=$out/$(basename "${scene%.*}")
  rm -rf "$work" && mkdir -p "$work"
  cp "$(dirname "$scene")"/*.{png,jpg,jpeg} "$work"/ 2> /dev/null || true
  given=$(for_gltfpack "$scene" "$work")
  gltfpack -noq -kn -i "$given" -o "$work/scene.glb" > /dev/null
  triangles=$("$tools/bpinfo" "$work/scene.glb" --json | python3 -c 'import json,sys; print(json.load(sys.stdin)["triangles"])')
  faces=()
  [ -z "${LEVELS:-}" ] || faces=(--faces "$LEVELS")
  "$tools/bplod" "$scene" "${faces[@]}" "${mode[@]}" "${profile[@]}" "${looks[@]}" -o "$work/levels" --name level --report "$work/report.json" -q > /dev/null
  "$tools/bplod" "$scene" "${faces[@]}" "${mode[@]}" -o "$work/colors" --name level --appearance color -q > /dev/null
  python3 -c '
import json, sys
report = json.load(open(sys.argv[1]))
for i, level in enumerate(report["counts"]["levels"]): print(i, level["faces"], level["error"])' "$work/report.json" |
  while read -r i count error; do
    diagonal=$("$tools/bpinfo" "$work/scene.glb" --json | python3 -c 'import json,math,sys; b=json.load(sys.stdin)["bounds"]; print(math.dist(b["min"],b["max"]))')
    pixels=$(python3 -c "print(int(max(48, min(512, $diagonal / $error))))")
    level=$work/levels/level_LOD$i.glb size=$(stat -c %s "$work/levels/level_LOD$i.glb") packs=()
    [ -z "${PACKED:-}" ] || { level=$work/placed$i.glb && place "$work/levels/level_LOD$i.glb" "$level"; }
    for option in "" -sa; do # that keep all parts, or may drop some: the better one that fits counts
      pack=$work/pack$i$option.glb
      if [ "${SAME:-triangles}" = bytes ]; then
        pack_into "$size" "$given" "$pack" $option
        [ "$(stat -c %s "$pack")" -gt "$size" ] || packs+=("$pack")
      else
        pack "$(python3 -c "print(min(1, $count / $triangles))")" "$given" "$pack" $option
        packs+=("$pack")
      fi
    done
    [ ${#packs[@]} -gt 0 ] || packs=("$pack")
    mapfile -t seen < <(node "$here/appearance/appearance.cjs" "$pixels" "$work/scene.glb" "$level" "$work/colors/level_LOD$i.glb" "${packs[@]}")
    best=2
    for ((k = 3; k < ${#seen[@]}; ++k)); do
      [ "$(python3 -c "print(${seen[k]%% *} > ${seen[best]%% *})")" = False ] || best=$k
    done
    pack=${packs[best - 2]}
    packed=$({ "$tools/bpinfo" "$pack" --json 2> /dev/null || echo '{"triangles": 0}'; } | python3 -c 'import json,sys; print(json.load(sys.stdin)["triangles"])')
    cell() { echo "${1// / | }"; }
    echo "| $name | $i | $count | $size | $pixels | $(cell "${seen[0]}") | $packed | $(stat -c %s "$pack") | $(cell "${seen[best]}") | $(cell "${seen[1]}") |"
  done
done
