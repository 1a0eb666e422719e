#!/usr/bin/env bash
# Pins the bytes of everything the tools write: one line for each file, its SHA-256 and its name. A change that must not
# change results is proved by it: the manifest is the same before and after.
#   tests/large/bytes.sh baseline MANIFEST BIN_DIR [MODELS [ONLY]]     writes MANIFEST
#   tests/large/bytes.sh run      MANIFEST BIN_DIR [MODELS [ONLY]]     compares with it, exit 1 if a line differs
# BIN_DIR holds the tools. MODELS: folder of scenes ($BP_MODELS, or ../shared/models). ONLY: a part of the names of the
# models to take. For each model: every fill, element, mode, target, format and profile, at a small resolution. The same
# work is repeated with 1, 2 and 3 threads, little and much memory, with a cache (twice), after a kill, and shared among
# jobs; these must give the same bytes at once. Models run in parallel, JOBS at a time (default: 2).
# Takes about ten minutes on two cores.
set -euo pipefail
mode=$1 manifest=$(realpath -m "$2") bin=$(realpath "$3")
models=$(realpath "${4:-${BP_MODELS:-../shared/models}}") only=${5:-}
export PATH="$bin:$PATH" LC_ALL=C
work=$(mktemp -d "${TMPDIR:-/tmp}/bp-bytes-XXXXXX")
trap 'rm -rf "$work"' EXIT

# name, then options of bpvox and bplod that it needs
scenes() {
  cat << 'END'
paper_horse.ply
nasty_libigl_tut_truck.obj
engine_2cylinder.glb
nasty_manifoldplus_chair.off
nasty_cgal_mech-holes-shark.off
nasty_ud_sample_tour_part_dieu.obj --up z
geo_3dfier_delft_rdnew.obj --up z
duck.dae
teapot_instances.DAE
END
}

# pin NAME FILE...: the lines of these files, or of all files below a folder
pin() {
  local name=$1 file
  shift
  while IFS= read -r -d '' file; do
    printf '%s  %s\n' "$(sha256sum < "$file" | cut -d' ' -f1)" "$model/$name/${file#./}"
  done < <(find "$@" -type f -print0 | sort -z) >> "../$model.lines"
}

# same NAME A B: an error if two files or folders differ
same() { diff -rq "$2" "$3" > /dev/null || echo "DIFFERS $model $1" >> "../$model.lines"; }

pipe_cases() {
  local fill element target
  for fill in flood winding none inside; do
    bpvox "$scene" "${up[@]}" --resolution 96 --fill $fill -q -j 1 --memory 256M -o $fill.bpv
    bpvox "$scene" "${up[@]}" --resolution 96 --fill $fill -q -j 3 -o again.bpv
    same "vox $fill" $fill.bpv again.bpv
    pin vox $fill.bpv
    rm again.bpv
  done
  for element in cube ball; do
    bpclose flood.bpv --scale 3vx --element $element --device cpu -j 1 -q -o $element.bpv
    bpclose flood.bpv --scale 3vx --element $element --device cpu -j 3 --memory 192M -q -o again.bpv
    same "close $element" $element.bpv again.bpv
    rm again.bpv
  done
  bpclose flood.bpv --scale 2% --device cpu --keep-cavities -q -o cavities.bpv
  bpclose inside.bpv --scale 1vx --device cpu -q -o inner.bpv
  bpclose winding.bpv --scale 3vx --device cpu -q -o wound.bpv
  scale_field flood.bpv > field.json
  bpclose flood.bpv --field field.json --device cpu -j 1 --memory 192M -q -o varied.bpv
  bpclose flood.bpv --field field.json --device cpu -j 3 -q -o again.bpv
  same "close field" varied.bpv again.bpv
  rm again.bpv
  scale_rules flood.bpv > rules.json
  bpscale rules.json flood.bpv | bpclose --device cpu -j 1 --memory 192M -q -o ruled.bpv
  bpclose flood.bpv --field rules.json --device cpu -j 3 -q -o again.bpv
  bpinfo ruled.bpv | grep checksum > ruled.sum
  bpinfo again.bpv | grep checksum > again.sum
  same "close rules" ruled.sum again.sum
  rm ruled.sum again.sum
  rm again.bpv
  pin close cube.bpv ball.bpv cavities.bpv inner.bpv wound.bpv varied.bpv ruled.bpv
  mesh cube.bpv faces.glb --faces 500
  mesh ball.bpv ball.ply --faces 500
  mesh flood.bpv open.obj --faces 300
  mesh cube.bpv closing.stl --faces 500 --enclose closing
  mesh cube.bpv input.ply --faces 500 --enclose input
  mesh cube.bpv scene.ply --faces 500 --enclose "$scene"
  mesh cube.bpv error.ply --error 2%
  mesh cube.bpv volume.ply --volume 1.3
  mesh cube.bpv quads.obj --faces 300 --quads
  mesh cube.bpv chain.gltf --faces 500,200,60
  mesh ball.bpv fit.glb --mode fit --faces 500
  mesh inner.bpv inside.ply --mode inside --faces 100
  mesh varied.bpv varied.ply --faces 500
}

# scale_field STREAM: scales of two to six voxels, with a box and a stroke in the middle of the scene
scale_field() {
  bpinfo "$1" --json | python3 -c '
import json, sys
info = json.load(sys.stdin)
voxel, low, high = info["voxel"], info["bounds"]["min"], info["bounds"]["max"]
middle = [(a + b) / 2 for a, b in zip(low, high)]
print(json.dumps({"base": 3 * voxel, "boxes": [{"min": low, "max": middle, "scale": 2 * voxel}],
                  "strokes": [{"mode": "increase", "position": middle, "support": 16 * voxel, "target": 6 * voxel}]}))'
}

# scale_rules STREAM: rules of all shapes
scale_rules() {
  bpinfo "$1" --json | python3 -c '
import json, sys
info = json.load(sys.stdin)
low, high = info["bounds"]["min"], info["bounds"]["max"]
at = lambda f: [a + f * (b - a) for a, b in zip(low, high)]
print(json.dumps({"base": "3vx", "rules": [
  {"view": [low], "per_distance": 0.02, "scale": "7vx"},
  {"at": [at(0.1), at(0.5), high], "radius": "4vx", "scale": "1.5vx"},
  {"box": [at(0.6), at(0.9)], "scale": "6vx", "mode": "increase"},
  {"at": at(0.4), "support": "16vx", "scale": "2vx", "mode": "decrease"}]}))'
}

# mesh STREAM OUTPUT OPTIONS...: alike with one thread and three, little memory and much
mesh() {
  local stream=$1 output=$2
  shift 2
  mkdir one three
  bpmesh "$stream" "$@" -q -j 1 --memory 512M -o "one/$output" || echo "status $?" > "one/$output.status"
  bpmesh "$stream" "$@" -q -j 3 -o "three/$output" || echo "status $?" > "three/$output.status"
  same "mesh $output" one three
  rm -r three
  mv one "mesh-$output"
  pin mesh "mesh-$output"
}

# lod NAME OPTIONS...
lod() {
  local name=$1
  shift
  bplod "$scene" "${up[@]}" --name m -q -o "lod-$name" "$@" > "lod-$name.list" || echo "status $?" > "lod-$name.status"
  find . -maxdepth 1 -name "lod-$name*" | while read -r made; do pin lod "$made"; done
}

lod_cases() {
  lod default --resolution 96
  lod faces --resolution 96 --faces 500,100
  lod fit --mode fit --faces 500,100 --resolution 96
  lod error --error 2% --levels 2
  lod winding --fill winding --faces 300 --resolution 96
  lod collision --profile collision --faces 300 --resolution 96
  lod occluder --profile occluder --resolution 96
  lod cage --profile cage --faces 200 --resolution 96
  tiles=("$scene" "${up[@]}" --name m -q --profile 3dtiles --resolution 128 --tile 64)
  bplod "${tiles[@]}" -j 1 -o tiles > tiles.list
  pin lod tiles tiles.list
  bplod "${tiles[@]}" -j 3 --memory 512M --cache cache -o cached > /dev/null
  bplod "${tiles[@]}" --cache cache -o from-cache > /dev/null
  bplod "${tiles[@]}" --cache parts --tiles 0..3 > /dev/null
  bplod "${tiles[@]}" --cache parts --tiles 3..1000000 > /dev/null
  bplod "${tiles[@]}" --cache parts -o from-parts > /dev/null
  bplod "${tiles[@]}" --cache killed -o resumed > /dev/null &
  local job=$!
  sleep 0.5
  kill -9 $job 2> /dev/null || true
  wait $job 2> /dev/null || true
  [ -e resumed/tileset.json ] || bplod "${tiles[@]}" --cache killed -o resumed > /dev/null
  local way
  for way in cached from-cache from-parts resumed; do same "tiles $way" tiles $way; done
}

# one NAME [OPTIONS...]
one() {
  model=$1
  shift
  up=("$@")
  scene=$models/$model
  mkdir "$work/$model"
  cd "$work/$model"
  : > "../$model.lines"
  set +e  # of a command before ||, bash would forget -e
  (set -e; pipe_cases; lod_cases) > log 2>&1 < /dev/null
  [ $? = 0 ] || echo "FAILED $model: $(tail -n 1 log)" >> "../$model.lines"
}

running=0
while read -r name options; do
  case $name in *"$only"*) ;; *) continue ;; esac
  # shellcheck disable=SC2086
  (one "$name" $options) &
  running=$((running + 1))
  [ $running -lt "${JOBS:-2}" ] || { wait -n && running=$((running - 1)); }
done < <(scenes)
wait
cat "$work"/*.lines | sort -k2 > "$work/manifest"
bad=$(grep -cE '^(DIFFERS|FAILED)' "$work/manifest" || true)
grep -E '^(DIFFERS|FAILED)' "$work/manifest" || true
if [ "$mode" = baseline ]; then
  cp "$work/manifest" "$manifest"
  echo "$(wc -l < "$manifest") files pinned in $manifest"
else
  diff "$manifest" "$work/manifest" | grep '^[<>]' | awk '{ print $1, $3 }' | sort -u -k2 > "$work/changed" || true
  cat "$work/changed"
  echo "$(wc -l < "$work/manifest") files, $(wc -l < "$work/changed") lines differ"
  [ ! -s "$work/changed" ] || bad=1
fi
[ "$bad" = 0 ]
