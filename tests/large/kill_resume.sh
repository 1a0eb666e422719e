#!/usr/bin/env bash
# Kills bplod --cache with SIGKILL at random moments, then lets it finish: the tileset must be the bytes of one that was
# never interrupted, and nothing else may be left.
#   tests/large/kill_resume.sh [KILLS [TRIANGLES [RESOLUTION]]]     default: 20 kills, 10^6 triangles, 256 voxels
# The tools are on PATH. Prints one line; exit status 1 if something differs or is left behind.
set -euo pipefail
kills=${1:-20} triangles=${2:-1000000} resolution=${3:-256}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir temp
bp-plant --triangles "$triangles" -o plant.ply > /dev/null
export TMPDIR=$work/temp
options=(plant.ply --resolution "$resolution" --tile 128 --profile 3dtiles -q)
begin=$(date +%s%N)
bplod "${options[@]}" -o whole > /dev/null
full=$(($(date +%s%N) - begin))
killed=0
for ((i = 0; i < kills; ++i)); do
  # Each try gets a random share of what a whole build takes; so some die early, some while files are written.
  bplod "${options[@]}" -o tiles --cache cache --overwrite > /dev/null &
  job=$!
  sleep "$(awk -v s=$((RANDOM * 32768 + RANDOM)) -v f="$full" -v n="$kills" 'BEGIN { printf "%.3f", s / 2 ^ 30 * f / 1e9 * 2 / (n < 4 ? 4 : n) + 0.02 }')"
  kill -9 $job 2> /dev/null && killed=$((killed + 1))
  wait $job 2> /dev/null || true
  if [ -e tiles/tileset.json ] && [ ! -e tiles/.partial ]; then rm -rf tiles cache; fi  # it was done before the kill; once more
done
bplod "${options[@]}" -o tiles --cache cache --overwrite > /dev/null
diff -r whole tiles || { echo "the bytes differ after $killed kills"; exit 1; }
left=$(ls -A . temp | grep -vxE 'plant.ply|temp|tiles|cache|whole|\.:|temp:|' || true)
[ -z "$left" ] || { echo "left behind: $left"; exit 1; }
echo "$killed kills: the same bytes, nothing left behind"
