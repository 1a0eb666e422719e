#!/usr/bin/env bash
# How much faster several nodes make one tileset than one node does. Nodes are simulated: each is bound to cores of its own on this host,
# and does one job at a time. The jobs are those of samples/farm, handed out by a plain loop, so that no Snakemake is needed.
#   tests/bench/farm.sh [TRIANGLES [NODES [OPTION...]]]    (10000000 3 --voxel 0.25 --tile 128); tools and samples on PATH
# Prints seconds of one node without parts, of one node, and of NODES nodes, then a table of the jobs, which tests/bench/farm_simulation.py
# reads. Fails if the bytes differ.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
triangles=${1:-10000000} nodes=${2:-3}
shift $(($# < 2 ? $# : 2))
options=(--profile 3dtiles --appearance off "$@")
[ $# -gt 0 ] || options+=(--voxel 0.25 --tile 128)
cores=$(($(nproc) / nodes))
[ $cores -gt 0 ] || { echo "farm: $nodes nodes need as many cores" >&2 && exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
TIMEFORMAT="%U %S" # of the processor
bp-plant --triangles "$triangles" -o plant.glb > /dev/null
nightly=$root/samples/nightly
options+=(--memory 8G -j "$cores")

now() { date +%s.%N; }
spent() { awk '{ printf "%.2f s of the processor", $1 + $2 }' "$1"; }
since() { awk -v a="$1" -v b="$(now)" 'BEGIN { printf "%.1f", b - a }'; }
on_node() { # NODE COMMAND...
  local first=$(($1 * cores))
  shift
  taskset -c "$first-$((first + cores - 1))" "$@"
}

# The next range of $1/queue, for one node after the other.
work_off() { # NODE OUT
  local range begin
  while range=$(flock "$2.lock" sh -c 'head -1 "$1" && sed -i 1d "$1"' sh "$2.queue") && [ -n "$range" ]; do
    begin=$(now)
    { time on_node "$1" "$nightly" --part "$range" plant.glb "$2" "${options[@]}" --report "$2.$range.json" 2>&3; } \
      3>&2 2> "$2.$range.cpu"
    echo "  node $1: $range in $(since "$begin") s" >> "$2.jobs"
  done
}

farm() { # NODES OUT
  local begin step node pids=()
  begin=$(now)
  on_node 0 "$nightly" --plan "$nodes" plant.glb "$2" "${options[@]}" > "$2.plan"
  python3 -c 'import json, sys; print(*json.load(sys.stdin)["ranges"], sep="\n")' < "$2.plan" > "$2.queue"
  echo "plan $(since "$begin") s: $(wc -l < "$2.queue") jobs"
  step=$(now)
  for ((node = 0; node < $1; ++node)); do work_off $node "$2" & pids+=($!); done
  for node in "${pids[@]}"; do wait "$node"; done
  cat "$2.jobs"
  echo "tiles $(since "$step") s"
  step=$(now)
  { time on_node 0 "$nightly" --one plant.glb "$2" "${options[@]}" 2> /dev/null; } 2> "$2.cpu"
  echo "put together and checked $(since "$step") s, $(spent "$2.cpu")"
  echo "$1 nodes of $cores cores: $(since "$begin") s"
}

begin=$(now)
on_node 0 "$nightly" --one plant.glb plain "${options[@]}" 2> /dev/null
echo "$triangles triangles, ${options[*]}"
echo "one node of $cores cores, without parts: $(since "$begin") s"
begin=$(now)
on_node 0 bpcheck plant.glb plain/plant.glb/tileset.json > /dev/null
echo "of this, the check: $(since "$begin") s"
farm 1 one
farm "$nodes" many
diff -r -x levels.tsv plain/plant.glb one/plant.glb
diff -r -x levels.tsv plain/plant.glb many/plant.glb
echo "same bytes"
{ time bplod plant.glb "${options[@]}" --explain -q > /dev/null; } 2> plan.cpu
echo "of the plan, bplod: $(spent plan.cpu)"
du -sb many/.cache many/plant.glb plant.glb | awk '{ print $2 "\t" $1 " bytes" }'
python3 - many.*..*.json << 'PYTHON'
import json, sys
print("job", "chunks_kept", "chunks", "processor", "voxelize", "measure", "close", "tiles", sep="\t")
for path in sys.argv[1:]:
    report = json.load(open(path))
    s, c = report["seconds"], report["counts"]
    processor = sum(map(float, open(path[:-5] + ".cpu").read().split()))
    close = sum(v for k, v in s.items() if k.startswith("close"))
    tiles = s["total"] - s["voxelize"] - s["measure the scene"] - close
    print(path.split(".", 1)[1][:-5], c["chunks_kept"], c["chunks"],
          *(f"{x:.2f}" for x in (processor, s["voxelize"], s["measure the scene"], close, tiles)), sep="\t")
PYTHON
