#!/usr/bin/env bash
# Whole streams by the GPU against the CPU, byte by byte: every model through bpclose (cube and ball, constant and
# varying scale, little memory and plenty, which give other tiles): eight comparisons a model.
#   tests/large/gpu_streams.sh BIN_DIR [MODELS [RESOLUTION [DEVICE [ONLY]]]]
# BIN_DIR holds bpvox, bpclose and bpinfo. MODELS: folder of scenes ($BP_MODELS, or ../shared/models). RESOLUTION: 256. DEVICE:
# cuda. ONLY: a part of the names of the models to take. Models that bpvox refuses are counted. Prints a line per model that differs, and the sums; exit 1 if any does.
set -euo pipefail
bin=$1
models=${2:-${BP_MODELS:-../shared/models}}
resolution=${3:-256}
device=${4:-cuda}
only=${5:-}
folder=$(mktemp -d "${TMPDIR:-/tmp}/bp-gpu-streams-XXXXXX")
trap 'rm -rf "$folder"' EXIT
equal=0 differ=0 refused=0 count=0

# same NAME: counts whether cpu.bp and gpu.bp in $folder are equal
same() {
  if cmp -s "$folder/cpu.bp" "$folder/gpu.bp"; then
    equal=$((equal + 1))
  else
    differ=$((differ + 1))
    echo "DIFFERS $1"
  fi
  rm -f "$folder/cpu.bp" "$folder/gpu.bp"
}

# close DEVICE MEMORY OUT OPTIONS...
close() {
  "$bin/bpclose" "$folder/solid.bp" --device "$1" --memory "$2" -q --overwrite -o "$folder/$3" "${@:4}"
}

# field: half of the scale in one corner of the scene
field() {
  "$bin/bpinfo" "$folder/solid.bp" --json | python3 -c '
import json, sys
b = json.load(sys.stdin)["bounds"]
low, high = b["min"], b["max"]
size = [h - l for l, h in zip(low, high)]
longest = max(size)
print(json.dumps({"base": 0.03 * longest,
                  "boxes": [{"min": low, "max": [l + s / 2 for l, s in zip(low, size)], "scale": 0.015 * longest}]}))' \
    > "$folder/field.json"
}

for model in "$models"/*; do
  case $model in *.md | *.tsv | *.txt) continue ;; *"$only"*) ;; *) continue ;; esac
  [ -f "$model" ] || continue
  name=$(basename "$model")
  if ! "$bin/bpvox" "$model" --resolution "$resolution" -q --overwrite -o "$folder/solid.bp" 2> /dev/null; then
    refused=$((refused + 1))
    continue
  fi
  count=$((count + 1))
  field
  for element in cube ball; do
    for scale in "--scale 3%" "--field $folder/field.json"; do
      for memory in 1G 8G; do
        # shellcheck disable=SC2086
        close cpu 4G cpu.bp --element $element $scale || true  # no file: differs
        # shellcheck disable=SC2086
        close "$device" $memory gpu.bp --element $element $scale || true
        same "$name bpclose $element ${scale%% *} memory $memory"
      done
    done
  done
done
echo "$count models, $refused refused: $equal streams equal, $differ differ"
[ "$differ" = 0 ] && [ "$equal" -gt 0 ]
