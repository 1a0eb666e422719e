#!/usr/bin/env bash
# How much faster several nodes make one tileset than one node does. Nodes are simulated: each is bound to cores of its own on this host,
# and does one job at a time. They share its memory, so one node is timed while the others are as busy: each makes the scene by itself.
# The jobs are those of samples/farm, handed out by a plain loop, so that no Snakemake is needed.
#   tests/bench/farm.sh [TRIANGLES [NODES [OPTION...]]]    (10000000 3 --voxel 0.25 --tile 128); tools and samples on PATH
# Prints seconds of each node by itself, and of all nodes together, then a table of the jobs, which samples/farm/simulate.py reads. Fails if
# the bytes differ.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
triangles=${1:-10000000} nodes=${2:-3}
shift $(($# < 2 ? $# : 2))
options=(--profile 3dtiles --appearance off "$@")
[ $# -gt 0 ] || options+=(--voxel 0.25 --tile 128)
mapfile -t of_nodes < <(lscpu -p=CPU,CORE | python3 -c '
import sys
cores = {}
for line in sys.stdin:
    if line[0] != "#":
        cpu, core = line.strip().split(",")
        cores.setdefault(core, []).append(cpu)
cores, nodes = list(cores.values()), int(sys.argv[1])
each = len(cores) // nodes
print(*(",".join(sum(cores[n * each:(n + 1) * each], [])) for n in range(nodes)), sep="\n")' "$nodes")
[ -n "${of_nodes[0]}" ] || { echo "farm: $nodes nodes need as many cores" >&2 && exit 2; }
cores=$(tr ',' '\n' <<< "${of_nodes[0]}" | wc -l) # as the system counts them
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
  taskset -c "${of_nodes[$1]}" "${@:2}"
}

# $2.queue, whose lines are parts of the step, for one node.
work_off() { # NODE OUT STEP
  local part begin name
  while part=$(flock "$2.lock" sh -c 'head -1 "$1" && sed -i 1d "$1"' sh "$2.queue") && [ -n "$part" ]; do
    begin=$(now)
    name=$2$3.${part%/*}
    { time on_node "$1" "$nightly" "$3" "$part" plant.glb "$2" "${options[@]}" --report "$name.json" 2>&3; } 3>&2 2> "$name.cpu"
    echo "  node $1: $3 $part in $(since "$begin") s, $(spent "$name.cpu")" >> "$2.jobs"
  done
}

all_nodes() { # OUT STEP PART...
  local step node pids=()
  step=$(now)
  printf '%s\n' "${@:3}" > "$1.queue"
  for ((node = 0; node < nodes; ++node)); do work_off $node "$1" "$2" & pids+=($!); done
  for node in "${pids[@]}"; do wait "$node"; done
  cat "$1.jobs" && rm "$1.jobs"
  echo "$2 $(since "$step") s"
}

alone() { # OUT STEP...
  local step
  step=$(now)
  { time on_node 0 "$nightly" "${@:2}" plant.glb "$1" "${options[@]}" 2> /dev/null; } 2> "$1.cpu"
  echo "$2 $(since "$step") s, $(spent "$1.cpu")"
}

# A farm of one machine.
by_itself() { # NODE
  local begin
  begin=$(now)
  on_node "$1" "$nightly" --plan 1 plant.glb "one$1" "${options[@]}" > /dev/null
  on_node "$1" "$nightly" --one plant.glb "one$1" "${options[@]}" 2> /dev/null
  echo "node $1 by itself: $(since "$begin") s"
}

listed() { python3 -c "import json, sys; plan = json.load(open(sys.argv[1])); print(*($2), sep='\n')" "$1"; }

farm() { # OUT
  local begin ranges checks
  begin=$(now)
  THREADS=$cores on_node 0 "$nightly" --plan "$nodes" plant.glb "$1" "${options[@]}" > "$1.plan"
  echo "--plan $(since "$begin") s"
  mapfile -t ranges < <(listed "$1.plan" 'plan["ranges"]')
  mapfile -t checks < <(listed "$1.plan" 'str(k + 1) + "/" + str(plan["checks"]) for k in range(plan["checks"])')
  [ -n "${ranges[0]}" ] || { echo "farm: a scene so small is made by one machine" >&2 && exit 2; }
  all_nodes "$1" --part "${ranges[@]}"
  alone "$1" --make
  all_nodes "$1" --check "${checks[@]}"
  alone "$1" --take ${#checks[@]}
  echo "$nodes nodes of $cores cores: $(since "$begin") s"
}

echo "$triangles triangles, ${options[*]}"
echo "nodes of cores ${of_nodes[*]}"
for ((node = 1; node < nodes; ++node)); do by_itself $node & done
by_itself 0
wait
begin=$(now)
{ time on_node 0 bpcheck -j "$cores" plant.glb one0/plant.glb/tileset.json > /dev/null; } 2> check.cpu
echo "of this, the check: $(since "$begin") s, $(spent check.cpu)"
farm many
for ((node = 0; node < nodes; ++node)); do diff -r -x levels.tsv one$node/plant.glb many/plant.glb; done
echo "same bytes"
{ time bplod plant.glb "${options[@]}" --explain -q > /dev/null; } 2> plan.cpu
echo "of the plan, bplod: $(spent plan.cpu)"
du -sb many/.cache many/plant.glb plant.glb | awk '{ print $2 "\t" $1 " bytes" }'
python3 - many--part.*.json << 'PYTHON'
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
