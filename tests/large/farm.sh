#!/usr/bin/env bash
# samples/farm on a Slurm of three nodes, one of which dies in the middle: the bytes of one machine. slurmctld, three slurmd and munge
# run on this host, on loopback, and end with this script. Prints seconds, and what happened to the node.
#   tests/large/farm.sh [TRIANGLES]    (200000); as root; tools and samples on PATH
# Packages of Debian 12: snakemake slurmctld slurmd slurm-client munge
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
for command in snakemake slurmctld slurmd sbatch munged bplod bp-plant; do
  PATH=$PATH:/usr/sbin command -v $command > /dev/null || { echo "skipped: there is no $command" && exit 0; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: starts daemons of other users, as root" && exit 0; }
work=$(mktemp -d)
chmod 755 "$work"
cd "$work"
pids=() night=
descendants() {
  local child
  for child in $(pgrep -P "$1"); do descendants "$child"; done
  echo "$1"
}

finish() {
  # A night whose Slurm is gone would ask for ever.
  [ -z "$night" ] || kill $(descendants "$night") 2> /dev/null || true
  for pid in "${pids[@]}"; do kill "$pid" 2> /dev/null || true; done
  [ ! -f munge/pid ] || kill "$(cat munge/pid)" || true
  wait
  cd / && rm -rf "$work"
}
trap finish EXIT

start_munge() {
  mkdir munge
  dd if=/dev/urandom of=munge/key bs=1 count=128 status=none
  chmod 400 munge/key
  chmod 711 munge
  chown -R munge:munge munge
  runuser -u munge -- /usr/sbin/munged --key-file="$work/munge/key" --socket="$work/munge/socket" --pid-file="$work/munge/pid" \
    --log-file="$work/munge/log" --seed-file="$work/munge/seed"
}

start_slurm() {
  mkdir state log spool-n{1,2,3}
  chown slurm state log
  cat > slurm.conf << CONF
ClusterName=farm
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmctldPort=16817
SlurmUser=slurm
AuthInfo=socket=$work/munge/socket
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SlurmdParameters=config_overrides
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
SlurmdTimeout=10
MpiDefault=none
SchedulerParameters=batch_sched_delay=0,sched_min_interval=100000
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool-%n
SlurmctldPidFile=$work/state/ctld.pid
SlurmdPidFile=$work/log/%n.pid
SlurmctldLogFile=$work/log/ctld
SlurmdLogFile=$work/log/%n
NodeName=n[1-3] NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=[17001-17003] CPUs=2 RealMemory=4000 State=UNKNOWN
PartitionName=tiles Nodes=n[1-3] Default=YES MaxTime=00:30:00 State=UP
CONF
  export SLURM_CONF=$work/slurm.conf
  /usr/sbin/slurmctld -D -f "$SLURM_CONF" > /dev/null 2>&1 &
  pids+=($!)
  for i in 1 2 3; do
    /usr/sbin/slurmd -D -N n$i -f "$SLURM_CONF" > /dev/null 2>&1 &
    pids+=($!)
  done
  for ((i = 0; i < 60; ++i)); do
    [ "$(sinfo -h -N -t idle -o %N 2> /dev/null | wc -l)" = 3 ] && return
    sleep 1
  done
  cat log/* >&2
  return 1
}

# stepd_of JOB: of this Slurm, and no other one on this host: it has files open in our folder.
stepd_of() {
  local pid
  for pid in $(pgrep -f "^slurmstepd: \[$1[.]batch\]"); do
    [[ $(readlink "/proc/$pid/cwd" "/proc/$pid/fd/"* 2> /dev/null) != *"$work/"* ]] || echo "$pid"
  done
}

# Its slurmd, and the job on it with all that it started, at once, as if the power were gone.
kill_node() {
  local job stepd=""
  for ((i = 0; i < 600; ++i)); do
    job=$(squeue -h -w n2 -t R -n tiles -o %A | head -1)
    [ -z "$job" ] || stepd=$(stepd_of "$job")
    [ -n "$stepd" ] && break
    kill -0 "$night" || break
    sleep 0.2
  done
  [ -n "$stepd" ] || { echo "n2 never had a job" && return 1; }
  sleep 1
  kill -9 "${pids[2]}" $(descendants "$stepd") 2> /dev/null || true
  echo "n2 died with job $job"
}

files() { (cd "$1" && find . -type f ! -name .key ! -name levels.tsv ! -name picture.png -exec sha256sum {} + | LC_ALL=C sort -k 2); }

triangles=${1:-200000} options=(--profile 3dtiles --voxel 0.25 --tile 128 --appearance off)
mkdir scenes
bp-plant --triangles "$triangles" -o scenes/plant.glb 2> /dev/null
begin=$SECONDS
bplod scenes/plant.glb "${options[@]}" -q -o one > /dev/null
echo "one machine: $((SECONDS - begin)) s"
start_munge
start_slurm
begin=$SECONDS
SNAKEMAKE="--profile $root/samples/farm/slurm" MACHINES=3 THREADS=2 MEMORY=2G BATCH=5 WAIT=2 \
  "$root/samples/farm/night" scenes out "${options[@]}" &
night=$!
kill_node
wait "$night" || { night= && cat out/.farm/log/snakemake >&2 && exit 1; }
night=
echo "three nodes, one of which died: $((SECONDS - begin)) s"
grep -h "Error executing rule" out/.farm/log/snakemake || { echo "no job was tried again" && exit 1; }
sinfo -h -N -o "%N %T" | sort
diff <(files one) <(files out/plant.glb) && echo "same bytes: $(files one | wc -l) files"
