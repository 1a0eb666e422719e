#!/usr/bin/env bash
# bpmesh --mode fit against meshopt_simplify alone: one JSON line per model, count of faces and mesh (fit_vs_meshopt.cpp).
# usage: fit_vs_meshopt.sh BUILD_DIR MODEL...      RESOLUTION, SCALE (voxels, a whole number), FACES (falling, commas) from the
#   environment
set -euo pipefail
build=$1; shift
: "${RESOLUTION:=192}" "${SCALE:=5}" "${FACES:=1000,300}"
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
# Whole voxels, and twice as many of half the size: the same closing but for what voxels stand out.
closing() { "$build/tools/bpvox" "$1" --voxel "$2" -q | "$build/tools/bpclose" --scale "$3vx" -q -o "$4" --overwrite; }
voxel() { "$build/tools/bpvox" "$1" --resolution "$RESOLUTION" -q | "$build/tools/bpinfo" --json | sed -n 's/.*"voxel": *\([0-9.e+-]*\).*/\1/p' | head -1; }
for model in "$@"; do
  edge=$(voxel "$model")
  closing "$model" "$edge" "$SCALE" "$work/closed.bpv"
  closing "$model" "$(awk "BEGIN { printf \"%.17g\", $edge / 2 }")" $((2 * SCALE)) "$work/finer.bpv"
  "$build/tools/bpmesh" "$work/closed.bpv" --mode fit --faces "$FACES" -o "$work/fit.ply" --overwrite -q
  "$build/tests/bench/fit_vs_meshopt" "$work/closed.bpv" "$work/finer.bpv" "$model" "$work"/fit*.ply |
    sed "s|^{|{\"model\": \"$(basename "${model%.*}")\", |"
done
