#!/usr/bin/env bash
# A grid of 5 x 5 x 5 copies of a model (the Beast: 8.1 million triangles) to a proxy in --memory, against CGAL's
# alpha_wrap_3 100/2000 of the same file in the same run. Prints one JSON line per program and the ratio of times.
# usage: beasts_vs_alpha_wrap.sh BIN_DIR MODEL.obj [MEMORY] [FACES] [RESOLUTION] [SCALE] [RUNS]
# BIN_DIR holds bpvox, bpclose, bpmesh. Memory: the peak of each tool as the kernel counts it.
set -euo pipefail
bin=$1 model=$2 memory=${3:-1G} faces=${4:-20000} resolution=${5:-1024} scale=${6:-1%} runs=${7:-1}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/bp-beasts-XXXXXX"); trap 'rm -rf "$work"' EXIT
dpkg -s libcgal-dev >/dev/null 2>&1 || { [ "$(id -u)" = 0 ] && apt-get install -y libcgal-dev || sudo apt-get install -y libcgal-dev; } >&2
g++ -O3 -DNDEBUG -std=c++17 "$here/alpha_wrap.cpp" -o "$work/alpha_wrap" -lgmp -lmpfr

python3 - "$model" "$work/grid.ply" <<'P'
import array, sys
points, faces = [], []
for line in open(sys.argv[1], errors="replace"):
    word = line.split()
    if word[:1] == ["v"]: points.append([float(x) for x in word[1:4]])
    if word[:1] == ["f"]:
        corner = [int(w.split("/")[0]) for w in word[1:]]
        corner = [c - 1 if c > 0 else len(points) + c for c in corner]
        faces += [(corner[0], corner[i], corner[i + 1]) for i in range(1, len(corner) - 1)]
step = [1.1 * (max(p[i] for p in points) - min(p[i] for p in points)) for i in range(3)]
with open(sys.argv[2], "wb") as out:
    out.write(("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
               "element face %d\nproperty list uchar int vertex_indices\nend_header\n" % (125 * len(points), 125 * len(faces))).encode())
    for k in range(125):
        move = [step[0] * (k % 5), step[1] * (k // 5 % 5), step[2] * (k // 25)]
        array.array("f", [p[i] + move[i] for p in points for i in range(3)]).tofile(out)
    for k in range(125):
        base, rows = k * len(points), bytearray()
        for f in faces:
            rows += b"\3" + b"".join((c + base).to_bytes(4, "little") for c in f)
        out.write(rows)
P

peak() { awk '/Maximum resident/ { m = $NF } END { printf "%d", m / 1024 }' "$1"; }
for _ in $(seq "$runs"); do
  command time -v -o "$work/peer.time" "$work/alpha_wrap" "$work/grid.ply" 100 2000 "$work/wrap.off" | tee -a "$work/peer"
  start=$(date +%s.%N)
  common=(--memory "$memory" --temp "$work" --overwrite)
  command time -v -o "$work/vox.time" "$bin/bpvox" "$work/grid.ply" --resolution "$resolution" "${common[@]}" |
    command time -v -o "$work/close.time" "$bin/bpclose" --scale "$scale" "${common[@]}" |
    command time -v -o "$work/mesh.time" "$bin/bpmesh" --enclose closing --faces "$faces" "${common[@]}" -o "$work/proxy.ply"
  end=$(date +%s.%N)
  python3 - "$start" "$end" "$(peak "$work/vox.time")" "$(peak "$work/close.time")" "$(peak "$work/mesh.time")" "$(peak "$work/peer.time")" \
    "$(sed -n '/^element face/{s/.* //p;q}' "$work/proxy.ply")" <<'P' | tee -a "$work/ours"
import json, sys
start, end, vox, close, mesh, peer, faces = sys.argv[1:]
print(json.dumps({"suite": "bpvox | bpclose | bpmesh", "seconds": round(float(end) - float(start), 3), "faces": int(faces),
                  "peak_mib": {"bpvox": int(vox), "bpclose": int(close), "bpmesh": int(mesh)}, "peer_peak_mib": int(peer)}))
P
done
python3 - "$work/peer" "$work/ours" <<'P'
import json, statistics, sys
peer = statistics.median(json.loads(l)["seconds"] for l in open(sys.argv[1]))
ours = statistics.median(json.loads(l)["seconds"] for l in open(sys.argv[2]))
print(json.dumps({"alpha_wrap_seconds": peer, "suite_seconds": ours, "ratio": round(ours / peer, 2)}))
P
