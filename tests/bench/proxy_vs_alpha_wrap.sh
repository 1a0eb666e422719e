#!/usr/bin/env bash
# File to checked proxy against CGAL's alpha_wrap_3 20/600, both from the same file in one run. Prints one JSON line per run and the ratio.
# usage: proxy_vs_alpha_wrap.sh BIN_DIR MODEL [FACES] [RESOLUTION] [SCALE] [RUNS]
set -euo pipefail
bin=$1 model=$2 faces=${3:-1000} resolution=${4:-256} scale=${5:-1%} runs=${6:-3}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
dpkg -s libcgal-dev >/dev/null 2>&1 || { [ "$(id -u)" = 0 ] && apt-get install -y libcgal-dev || sudo apt-get install -y libcgal-dev; } >&2
g++ -O3 -DNDEBUG -std=c++17 "$here/alpha_wrap.cpp" -o "$work/alpha_wrap" -lgmp -lmpfr
now() { date +%s.%N; }
for _ in $(seq "$runs"); do
  "$work/alpha_wrap" "$model" 20 600 "$work/wrap.off" | tee -a "$work/peer"
  start=$(now)
  "$bin/bpvox" "$model" --resolution "$resolution" | "$bin/bpclose" --scale "$scale" | "$bin/bpmesh" --enclose closing --faces "$faces" -o "$work/proxy.glb" --overwrite
  "$bin/bpcheck" "$model" "$work/proxy.glb" --json >"$work/check.json"
  end=$(now)
  python3 - "$start" "$end" "$work/check.json" <<'P' | tee -a "$work/ours"
import json, sys
c = json.load(open(sys.argv[3]))
print(json.dumps({"suite": "file to checked proxy", "seconds": round(float(sys.argv[2]) - float(sys.argv[1]), 3), "check": c}))
P
done
python3 - "$work/peer" "$work/ours" <<'P'
import json, statistics, sys
peer = statistics.median(json.loads(l)["seconds"] for l in open(sys.argv[1]))
ours = statistics.median(json.loads(l)["seconds"] for l in open(sys.argv[2]))
print(json.dumps({"alpha_wrap_seconds": peer, "suite_seconds": ours, "ratio": round(ours / peer, 2)}))
P
