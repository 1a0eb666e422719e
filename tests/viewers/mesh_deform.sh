#!/usr/bin/env bash
# Blender binds our cages with its modifier Mesh Deform, and takes vertices where bpdeform takes them: a sheared cage, and a bent
# one. Its coordinates are harmonic and computed on a grid, ours are mean value, so the bars are shares of the diagonal. Without Blender the test is
# skipped (77).
#   tests/viewers/mesh_deform.sh FOLDER [SCENE...]    FOLDER keeps the files; SCENEs: besides generated ones; the tools are on PATH
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
command -v blender > /dev/null || { echo "skipped: blender is not installed"; exit 77; }
folder=$1
shift
scenes=(figure.obj truck.obj)
for scene; do scenes+=("$(realpath "$scene")"); done
mkdir -p "$folder" && cd "$folder"
"$here/../../samples/scenes.py" . > /dev/null

# pose FILE AWK: the cage with other vertices, as x y z and the share t of the height (axis y).
pose() {
  awk "FNR == NR { if (/^v /) { if (!n++ || \$3 < lo) lo = \$3; if (n == 1 || \$3 > hi) hi = \$3 } next }
    /^v / { x = \$2; y = \$3; z = \$4; t = (y - lo) / (hi - lo); h = hi - lo; $2
            printf \"v %.17g %.17g %.17g\\n\", x, y, z; next } { print }" cage.obj cage.obj > "$1"
}
failed=0
for scene in "${scenes[@]}"; do
  bplod "$scene" --profile cage --faces 600 --name scene -q -o made --overwrite > /dev/null
  cp made/scene_cage.obj cage.obj
  pose sheared.obj 'x = x + 0.5 * y; z = 1.5 * z'
  pose bent.obj 'x = x + 0.3 * h * t * t; y = y - 0.05 * h * t * t'
  bpdeform bind "$scene" cage.obj -o weights.bpw --overwrite
  for kind in sheared bent; do bpdeform apply weights.bpw $kind.obj -o moved_$kind.obj --overwrite -q; done
  blender -b --factory-startup --python-exit-code 1 -P "$here/mesh_deform.py" -- "$scene" cage.obj sheared.obj moved_sheared.obj \
    bent.obj moved_bent.obj | grep '^{' > said || { echo "$scene: Blender fails"; failed=1; }
  cat said
  python3 - << 'P' || failed=1
import json, sys
lines = [json.loads(line) for line in open("said")]
sys.exit(len(lines) != 2 or any(line["mean_apart"] > 0.005 or line["mean_move"] < 0.01 for line in lines))
P
done
exit $failed
