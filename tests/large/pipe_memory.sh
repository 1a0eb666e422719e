#!/usr/bin/env bash
# Peak memory of `bpvox | bpclose --memory 1G` on generated plants of 20 and 100 million triangles, PLY and GLB: each
# process stays below --memory, and five times the triangles take at most 5 percent more.
#   tests/large/pipe_memory.sh BIN_DIR [MILLIONS [MEMORY_MIB [RESOLUTION...]]]
# BIN_DIR holds tools/ and samples/. MILLIONS (20) is the smaller scene; with fewer triangles give less memory, in
# proportion, or the smaller scene fits into it and the two do not compare. RESOLUTION: 1024. Scratch: $TMPDIR; 2.5 GB
# for 20 and 100 million. Prints PASS or FAIL and the figures; exit 1 if any FAIL.
set -euo pipefail
bin=$1
millions=${2:-20}
memory=${3:-1024}
resolutions=("${@:4}")
[ ${#resolutions[@]} -gt 0 ] || resolutions=(1024)
folder=$(mktemp -d "${TMPDIR:-/tmp}/bp-large-XXXXXX")
trap 'rm -rf "$folder"' EXIT
verdict=0

# run FORMAT MILLIONS RESOLUTION: sets vox and close, peak resident MiB as the kernel counts them (VmHWM).
run() {
  local common=(--memory "${memory}M" --temp "$folder" --overwrite)
  "$bin/tools/bpvox" "$folder/$2.$1" --resolution "$3" "${common[@]}" --report "$folder/vox.json" |
    "$bin/tools/bpclose" --scale 20vx "${common[@]}" --report "$folder/close.json" -o "$folder/out.bp"
  vox=$(peak "$folder/vox.json")
  close=$(peak "$folder/close.json")
}
peak() { sed -n 's/.*"peak_memory_bytes": \([0-9]*\).*/\1/p' "$1" | awk '{ printf "%d", $1 / 1048576 }'; }

# judge TOOL FORMAT RESOLUTION SMALL LARGE
judge() {
  local word=PASS
  [ "$4" -lt "$memory" ] && [ "$5" -lt "$memory" ] && [ $((100 * $5)) -le $((105 * $4)) ] || word=FAIL
  echo "$word $1 $2 at $3, --memory $memory MiB: $4 MiB for $millions million triangles, $5 MiB for $((5 * millions))"
  [ $word = PASS ] || verdict=1
}

for format in ply glb; do
  for count in "$millions" $((5 * millions)); do
    "$bin/samples/bp-plant" --triangles "${count}000000" --seed 7 -o "$folder/$count.$format" > /dev/null
  done
  for resolution in "${resolutions[@]}"; do
    run "$format" "$millions" "$resolution"
    small_vox=$vox small_close=$close
    run "$format" $((5 * millions)) "$resolution"
    judge bpvox "$format" "$resolution" "$small_vox" "$vox"
    judge bpclose "$format" "$resolution" "$small_close" "$close"
  done
  rm "$folder"/*."$format"
done
exit $verdict
