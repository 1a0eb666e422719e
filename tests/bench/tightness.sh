#!/usr/bin/env bash
# How tight proxies are with the scene's own triangles inside: one line per model and number of faces. ratio: volume over the scene's own
# (it means something for closed scenes without overlaps only). outward: largest sampled distance from proxy to scene; symmetric: the larger
# of both ways; as shares of the diagonal. cpu_s: of bpmesh, one thread.
# usage: tightness.sh BIN_DIR MODEL... (environment: FACES="200 706 1000 2000", RESOLUTION=384)
set -euo pipefail
bin=$1; shift
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
TIMEFORMAT=%U
printf '%-28s %7s %7s %8s %9s %9s %7s  %s\n' model faces made ratio outward symmetric cpu_s verdict
for model in "$@"; do
  "$bin/bpvox" "$model" --resolution "${RESOLUTION:-384}" --threads 1 -q >"$work/voxels"
  "$bin/bpinfo" "$model" --json >"$work/info.json"
  for faces in ${FACES:-200 706 1000 2000}; do
    { time "$bin/bpmesh" "$work/voxels" --enclose "$model" --faces "$faces" --threads 1 -q -o "$work/proxy.glb" --overwrite 2>"$work/errors"; } 2>"$work/seconds"
    verdict=holds
    "$bin/bpcheck" "$model" "$work/proxy.glb" --json >"$work/check.json" || verdict=FAILS
    python3 - "$work" "$(basename "$model")" "$faces" "$verdict" <<'P'
import json, math, sys
work, model, faces, verdict = sys.argv[1:]
bounds = json.load(open(work + "/info.json"))["bounds"]
diagonal = math.dist(bounds["min"], bounds["max"])
check = json.load(open(work + "/check.json"))
m = check["measures"]
ratio = "-" if m["volume_ratio"] is None else f'{abs(m["volume_ratio"]):.4f}'
outward, inward = (m[k]["max"] / diagonal for k in ("proxy_to_scene", "scene_to_proxy"))
print(f'{model:28} {faces:>7} {check["proxy"]["triangles"]:7} {ratio:>8} {outward:9.4f} {max(outward, inward):9.4f} '
      f'{float(open(work + "/seconds").read()):7.2f}  {verdict}')
P
  done
done
