#!/usr/bin/env bash
# Peak memory and time of `bpvox | bpclose | bpmesh --memory 1G` on generated plants of 1, 10 and 100 million triangles.
#   tests/large/pipe_memory.sh [-m MEMORY_MIB] [-r RESOLUTION] [-s SCALE] [-f FACES] [-t ply|glb] [-c] BIN_DIR [MILLIONS...]
# BIN_DIR holds tools/ and samples/. Defaults: 1024 MiB, resolution 1024, scale 5vx, 5000 faces, ply, 1 10 100. -c: bpcheck of each
# result too. MILLIONS must rise. Judged:
#   memory  no tool's peak (VmHWM) reaches --memory;
#   growth  no tool's peak is more than 10 percent above that of the scene before, if that one was larger on disk than a quarter
#           of --memory (what fits into memory is not spilled, and the two do not compare);
#   time    the pipe takes at most 1.15 times as long per triangle as for the scene before, per decade.
# Scratch: $TMPDIR; 20 bytes a triangle of the largest scene, and its spilled triangles, about as many. Prints one line of
# figures for each scene, then PASS or FAIL for each of these; exit 1 if any FAIL.
set -euo pipefail
memory=1024 resolution=1024 scale=5vx faces=5000 format=ply check=
while getopts m:r:s:f:t:c option; do
  case $option in
    m) memory=$OPTARG ;; r) resolution=$OPTARG ;; s) scale=$OPTARG ;; f) faces=$OPTARG ;; t) format=$OPTARG ;; c) check=yes ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
bin=$1
shift
[ $# -gt 0 ] || set -- 1 10 100
folder=$(mktemp -d "${TMPDIR:-/tmp}/bp-large-XXXXXX")
trap 'rm -rf "$folder"' EXIT
tools=(bpvox bpclose bpmesh)
verdict=0

peak() { sed -n 's/.*"peak_memory_bytes": \([0-9]*\).*/\1/p' "$folder/$1.json" | awk '{ printf "%d", $1 / 1048576 }'; }

# judge PASSED WHAT...
judge() {
  local word=FAIL
  if [ "$1" = 1 ]; then word=PASS; else verdict=1; fi
  shift
  echo "$word $*"
}
holds() { awk "BEGIN { print ($1) ? 1 : 0 }"; }

last_millions= last_seconds= last_bytes=0 last_peaks=()
for millions in "$@"; do
  scene=$folder/scene.$format
  begin=$(date +%s.%N)
  "$bin/samples/bp-plant" --triangles "${millions}000000" --seed 7 -o "$scene" > /dev/null
  made=$(date +%s.%N)
  bytes=$(stat -c %s "$scene")
  common=(--memory "${memory}M" --temp "$folder" --overwrite)
  "$bin/tools/bpvox" "$scene" --resolution "$resolution" "${common[@]}" --report "$folder/bpvox.json" |
    "$bin/tools/bpclose" --scale "$scale" "${common[@]}" --report "$folder/bpclose.json" |
    "$bin/tools/bpmesh" --faces "$faces" "${common[@]}" --report "$folder/bpmesh.json" -o "$folder/proxy.glb"
  finished=$(date +%s.%N)
  seconds=$(awk "BEGIN { printf \"%.2f\", $finished - $made }")
  peaks=()
  for tool in "${tools[@]}"; do peaks+=("$(peak "$tool")"); done
  echo "$millions million triangles, $((bytes >> 20)) MiB: made in $(awk "BEGIN { printf \"%.1f\", $made - $begin }") s, pipe $seconds s," \
    "peaks ${tools[*]}: ${peaks[*]} MiB"
  for i in "${!tools[@]}"; do
    judge "$((peaks[i] < memory))" "memory ${tools[i]}: ${peaks[i]} MiB of $memory"
    [ "$last_bytes" -gt $((memory << 18)) ] || continue
    judge "$((100 * peaks[i] <= 110 * last_peaks[i]))" "growth ${tools[i]}: ${last_peaks[i]} MiB for $last_millions million, ${peaks[i]} MiB for $millions"
  done
  if [ -n "$last_seconds" ]; then
    judge "$(holds "$seconds <= $last_seconds * $millions / $last_millions * exp(log(1.15) * log($millions / $last_millions) / log(10))")" \
      "time: $last_seconds s for $last_millions million, $seconds s for $millions"
  fi
  if [ -n "$check" ]; then
    judge "$("$bin/tools/bpcheck" "$scene" "$folder/proxy.glb" > "$folder/check.txt" && echo 1 || echo 0)" \
      "check: $(tail -n 1 "$folder/check.txt")"
  fi
  rm "$scene"
  last_millions=$millions last_seconds=$seconds last_bytes=$bytes last_peaks=("${peaks[@]}")
done
exit $verdict
