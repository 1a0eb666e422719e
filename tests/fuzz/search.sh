#!/usr/bin/env bash
# Long search of one fuzzer: searches RUNS inputs, in processes of at most 20,000, and prints one line at the end:
#   date commit fuzzer: executions, crashes, hangs, leftovers
# Usage: tests/fuzz/search.sh BUILD FOLDER FUZZER RUNS      FUZZER: stream_stages, turned, scene, draco, weights,
#   tileset, options, brick_stream
# BUILD is a build with fuzzers:
#   CC=clang CXX=clang++ cmake -S . -B BUILD -G Ninja -DBP_FUZZ=ON -DBP_CUDA=OFF && ninja -C BUILD fuzzers
# FOLDER keeps the corpus, so that a later search goes on from there, and the inputs of findings (FOLDER/FUZZER.found).
# One of them alone: BUILD/tests/fuzz/fuzz_FUZZER INPUT. Once mended, it goes to tests/data/bugs/FUZZER/WHAT.input.
# Status: 0 if there is no finding.
set -euo pipefail
build=$(realpath "$1") folder=$2 fuzzer=$3 runs=$4
mkdir -p "$folder/$fuzzer" "$folder/$fuzzer.found"
folder=$(realpath "$folder")
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d "$([ -w /dev/shm ] && echo /dev/shm || echo /tmp)/bp-search-XXXXXX")
log=$scratch.log
trap 'rm -rf "$scratch" "$log"' EXIT

done=0 leftovers=0 seed=$RANDOM
while ((done < runs)); do
  piece=$((runs - done < 20000 ? runs - done : 20000)) status=0
  TMPDIR=$scratch "$build/tests/fuzz/fuzz_$fuzzer" -runs=$piece -seed=$((++seed)) -timeout=1200 -max_len=512 -len_control=0 \
    -rss_limit_mb=4096 -malloc_limit_mb=2048 -print_final_stats=1 -verbosity=0 \
    -artifact_prefix="$folder/$fuzzer.found/" "$folder/$fuzzer" > "$log" 2>&1 || status=$?
  executed=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  ((done += ${executed:-1}))
  if ((status == 0)); then
    leftovers=$((leftovers + $(find "$scratch" -mindepth 1 | wc -l)))
  else
    cp "$log" "$folder/$fuzzer.found/$(date +%s).log"
  fi
  find "$scratch" -mindepth 1 -delete
done
logs=$folder/$fuzzer.found
hangs=$(cat "$logs"/*.log 2> /dev/null | grep -cE "^fuzz: hang|libFuzzer: timeout" || true)
crashes=$(($(find "$logs" -name '*.log' | wc -l) - hangs))
echo "$(date +%F) $(git -C "$here" rev-parse --short HEAD) $fuzzer: $done executions, $crashes crashes, $hangs hangs over 10 s, $leftovers leftovers"
((crashes + hangs + leftovers == 0))
