#!/usr/bin/env bash
# The hulls of three links, each in a file of its own, as MuJoCo loads them: models and URDFs as they were written, and one
# model that includes all three. Without MuJoCo there is nothing to load, and the test is skipped (77).
#   tests/validators/robots/run.sh LOADER      the tools are on PATH
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
[ -x "${1:-}" ] || { echo "skipped: MuJoCo is not installed (libmujoco-dev)"; exit 77; }
loader=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$here/links.py" .
fail() { echo "$1"; exit 1; }

for format in obj stl; do
  for link in base forearm cup; do
    bplod $link.obj --up z --profile collision --hull-files $format --hull-corners 32 -o $format -q > /dev/null
    bpcheck --convex $link.obj $format/${link}_unreal.glb -q > /dev/null || fail "$link: the hulls do not enclose it"
    hulls=$(ls $format/${link}_hull_*.$format | wc -l)
    for file in $format/${link}_hull_*.$format; do
      bpcheck --convex "$file" -q > /dev/null || fail "$file: is not convex"
    done
    for model in ${link}_mujoco.xml $link.urdf; do
      "$loader" $format/$model | tee said
      grep -q "meshes $hulls geoms $hulls " said || fail "$model: does not hold $hulls hulls"
      [ "$(sed 's/.*corners //' said)" -le 32 ] || fail "$model: a hull has more than 32 corners"
    done
  done
  { echo '<mujoco model="robot">'
    for link in base forearm cup; do echo "  <include file=\"${link}_mujoco.xml\"/>"; done
    echo '</mujoco>'; } > $format/robot.xml
  "$loader" $format/robot.xml
done
