#!/usr/bin/env bash
# bpmesh --mode fit against meshopt_simplify alone: one JSON line per model, count of faces and mesh (fit_vs_meshopt.cpp).
# usage: fit_vs_meshopt.sh BUILD_DIR MODEL...      RESOLUTION, SCALE, FACES (falling, commas) from the environment
set -euo pipefail
build=$1; shift
: "${RESOLUTION:=192}" "${SCALE:=2%}" "${FACES:=1000,300}"
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
closing() { "$build/tools/bpvox" "$1" --resolution "$2" -q | "$build/tools/bpclose" --scale "$SCALE" -q -o "$3" --overwrite; }
for model in "$@"; do
  closing "$model" "$RESOLUTION" "$work/closed.bpv"
  closing "$model" $((2 * RESOLUTION)) "$work/finer.bpv"
  "$build/tools/bpmesh" "$work/closed.bpv" --mode fit --faces "$FACES" -o "$work/fit.ply" --overwrite -q
  "$build/tests/bench/fit_vs_meshopt" "$work/closed.bpv" "$work/finer.bpv" "$model" "$work"/fit.*.ply |
    sed "s|^{|{\"model\": \"$(basename "${model%.*}")\", |"
done
