#!/usr/bin/env bash
# What the defaults give: volumes over that of `bpmesh --enclose SCENE`, which is the tightest. One line per model.
#   closing   bpmesh --enclose closing, the default of the pipe before decision 0017
#   pipe      the pipe of the README as it is
#   lod       bplod --profile collision, the finest level
# made: faces of the pipe and of bplod. cpu_s: seconds of processor time of bpmesh (closing, pipe) and of bplod, one thread.
# usage: default_volume.sh BIN_DIR MODEL... (environment: FACES=500 RESOLUTION=256 SCALE=2%)
set -euo pipefail
bin=$1; shift
faces=${FACES:-500}
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
TIMEFORMAT=%U
mesh() {  # mesh NAME OPTION...: cpu seconds into NAME.s
  local name=$1; shift
  { time "$bin/bpmesh" "$work/closed" --faces "$faces" --threads 1 -q -o "$work/$name.ply" --overwrite "$@"; } 2> "$work/$name.s"
}
volume() { "$bin/bpinfo" "$1" --json | python3 -c 'import json, sys; m = json.load(sys.stdin); print(m["volume"], m["triangles"])'; }
printf '%-28s %11s %8s %8s %8s %11s %20s\n' model scene closing pipe lod made cpu_s
for model in "$@"; do
  "$bin/bpvox" "$model" --resolution "${RESOLUTION:-256}" --threads 1 -q | "$bin/bpclose" --scale "${SCALE:-2%}" --threads 1 -q > "$work/closed"
  mesh closing --enclose closing
  mesh scene --enclose "$model"
  mesh pipe
  rm -rf "$work/lod"
  { time "$bin/bplod" "$model" --profile collision --faces "$faces" --threads 1 -q --name lod -o "$work/lod" > "$work/list"; } 2> "$work/lod.s"
  "$bin/bpcheck" "$model" "$work/pipe.ply" > "$work/verdict" || { cat "$work/verdict"; exit 1; }
  python3 - "$(basename "$model")" "$(volume "$work/scene.ply")" "$(volume "$work/closing.ply")" "$(volume "$work/pipe.ply")" \
    "$(volume "$work/lod/lod_unity.glb")" "$(cat "$work/closing.s") $(cat "$work/pipe.s") $(cat "$work/lod.s")" << 'P'
import sys
model, scene, closing, pipe, lod, seconds = sys.argv[1:]
tight = float(scene.split()[0])
ratio = lambda text: float(text.split()[0]) / tight
print(f'{model:28} {tight:11.4g} {ratio(closing):8.3f} {ratio(pipe):8.3f} {ratio(lod):8.3f} '
      f'{pipe.split()[1] + " " + lod.split()[1]:>11} {seconds:>20}')
P
done
