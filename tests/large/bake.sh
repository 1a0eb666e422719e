#!/usr/bin/env bash
# Time of baking per triangle and per texel, by threads. Needs bplod on PATH and python3 (standard library).
# usage: bake.sh TOWN.py [THREADS,...]      TOWN.py: samples/town.py; by default 2 and all cores
# Two levels of one town: one with few texels and one with many. textures = a * triangles + b * texels in both.
set -euo pipefail
town=$1 all=$(nproc)
threads=${2:-2,$all}
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT
python3 "$town" "$work" "${HOUSES:-70000}" > /dev/null
bake() { # THREADS NAME OPTION...
  bplod "$work/town.obj" "${@:3}" --threads "$1" -o "$work/out" --overwrite --name level --report "$work/$2.json" -q > /dev/null
  mv "$work/out/level_LOD0.glb" "$work/$2.glb"
}
echo "cores $all; $(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2)"
for n in ${threads//,/ }; do
  bake "$n" few --resolution 32 --faces 1000
  bake "$n" many --resolution "${FINE:-768}" --faces 12000
  python3 - "$work" "$n" <<'PY'
import hashlib, json, struct, sys
work, threads = sys.argv[1], int(sys.argv[2])

def texels(path):  # of the JPEG in a GLB
    data = open(path, "rb").read()
    at = data.index(b"\xff\xd8\xff")
    at += 2
    while data[at + 1] not in (0xC0, 0xC2):
        at += 2 + struct.unpack(">H", data[at + 2:at + 4])[0]
    height, width = struct.unpack(">HH", data[at + 5:at + 9])
    return width * height

runs = []
for name in ("few", "many"):
    report = json.load(open(f"{work}/{name}.json"))
    runs.append((report["seconds"]["textures"], texels(f"{work}/{name}.glb"), report["counts"]["triangles"], report["counts"]["levels"][0]["faces"],
                 report["seconds"]["total"], report["peak_memory_bytes"] >> 20, hashlib.sha256(open(f"{work}/{name}.glb", "rb").read()).hexdigest()[:12]))
(t0, x0, n, *_), (t1, x1, *_) = runs
b = (t1 - t0) / (x1 - x0)
a = (t0 - b * x0) / n
for name, r in zip(("few", "many"), runs):
    print(f"{threads:3} threads, {name:4} texels: textures {r[0]:6.2f} s of {r[4]:6.2f} s, {r[1]} texels, {r[2]} triangles, {r[3]} faces, {r[5]} MiB, {r[6]}")
print(f"{threads:3} threads: {a * 1e6:.2f} us a triangle, {b * 1e6:.2f} us a texel; on one core {a * 1e6 * threads:.2f} and {b * 1e6 * threads:.2f}", flush=True)
PY
done
