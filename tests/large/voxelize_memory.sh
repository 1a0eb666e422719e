#!/usr/bin/env bash
# Peak memory of bpvox on generated plants of 20 and 100 million triangles: below --memory, and the same for both.
#   tests/large/voxelize_memory.sh BIN_DIR [SCRATCH_DIR [MEMORY_MIB [RESOLUTION]]]
# BIN_DIR holds tools/ and samples/. Needs 2.5 GB in SCRATCH_DIR. Exit 1 if the promise is broken.
set -eu
bin=$1
folder=$(mktemp -d "${2:-${TMPDIR:-/tmp}}/bp-large-XXXXXX")
memory=${3:-1024}
resolution=${4:-512}
trap 'rm -rf "$folder"' EXIT

peak() {  # MiB, from the report
  "$bin/samples/bp-plant" --triangles "$1" --seed 7 -o "$folder/plant.ply" --overwrite > /dev/null
  "$bin/tools/bpvox" "$folder/plant.ply" --resolution "$resolution" --memory "${memory}M" --temp "$folder" \
    -o "$folder/out.bp" --report "$folder/report.json" --overwrite
  sed -n 's/.*"peak_memory_bytes": \([0-9]*\).*/\1/p' "$folder/report.json" | awk '{ printf "%d", $1 / 1048576 }'
}
small=$(peak 20000000)
large=$(peak 100000000)
echo "peak of bpvox --memory ${memory}M: $small MiB for 20 million triangles, $large MiB for 100 million"
[ "$small" -lt "$memory" ] && [ "$large" -lt "$memory" ] || { echo "above --memory"; exit 1; }
[ "$large" -le $((small * 5 / 4 + 16)) ] || { echo "grows with the scene"; exit 1; }
