#!/usr/bin/env bash
# The whole bpclose process against the same closing by scipy.ndimage's distance transforms, in one run: same voxels, and the ratio.
# usage: closing_vs_scipy.sh BUILD_DIR MODEL [RESOLUTION] [SCALE_VOX] [RUNS]      (a build with -DBP_BENCH=ON)
# Ours: read the stream, close (cube, then ball), fill cavities, write the stream. Peer: distance_transform_cdt and
# distance_transform_edt on arrays already in memory, cropped to what the dilation reaches; filling is left out of its time.
set -euo pipefail
export LC_ALL=C
build=$1 model=$2 resolution=${3:-512} scale=${4:-20} runs=${5:-5}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
python=""
find_python() { for p in /usr/bin/python3 python3; do "$p" -c 'import scipy.ndimage' 2>/dev/null && python=$p && return; done; return 1; }
find_python || { { [ "$(id -u)" = 0 ] && apt-get install -y python3-scipy || sudo apt-get install -y python3-scipy; } >&2; find_python; }
"$build/tools/bpvox" "$model" --resolution "$resolution" -o "$work/solid.bps"
for _ in $(seq "$runs"); do
  start=$EPOCHREALTIME
  "$build/tools/bpclose" --scale "${scale}vx" --element cube "$work/solid.bps" -o "$work/closed.bps" --overwrite --report "$work/report.json" --device cpu
  awk "BEGIN { printf \"%.4f\\n\", $EPOCHREALTIME - $start }" >>"$work/seconds"
done
"$build/tests/bench/stream_to_raw" "$work/closed.bps" "$work" >"$work/box.json"
"$python" "$here/closing_by_scipy.py" "$work" "$scale"
