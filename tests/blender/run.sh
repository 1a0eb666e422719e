#!/usr/bin/env bash
# The add-on in Blender, packed and installed as users do it, and tested with generated scenes. Without Blender the tests are skipped (77), and
# without a virtual screen the one in a window.
#   tests/blender/run.sh FOLDER install      makes scenes, packs the add-on and installs it; FOLDER keeps the files
#   tests/blender/run.sh FOLDER TEST.py      afterwards: one of the tests; the tools are on PATH
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
skip() { echo "skipped: $1"; exit 77; }
command -v blender > /dev/null || skip "blender is not installed"
mkdir -p "$1" && cd "$1"
export BP_SCENES=$PWD/scenes BLENDER_USER_SCRIPTS=$PWD/user BLENDER_USER_CONFIG=$PWD/config PYTHONDONTWRITEBYTECODE=1
if [ "$2" = install ]; then
  rm -rf scenes user config addon.zip
  mkdir user config
  "$here/../../samples/scenes.py" scenes truck figure house
  "$here/../../samples/town.py" scenes/town 9
  "$here/../../tools/blender/pack.py" addon.zip
  blender -b --factory-startup --python-exit-code 1 --python-expr "import bpy; bpy.ops.preferences.addon_install(filepath='$PWD/addon.zip')"
  [ -f user/addons/bounding_proxies_addon/__init__.py ] || { echo "the add-on was not installed"; exit 1; }
  exit 0
fi
[ -f user/addons/bounding_proxies_addon/__init__.py ] || { echo "run '$0 $1 install' first"; exit 1; }
export TMPDIR=$PWD/tmp-${2%.py}
rm -rf "$TMPDIR" && mkdir "$TMPDIR"
if [ "$2" != window.py ]; then
  exec blender -b --factory-startup --python-exit-code 1 -P "$here/$2"
fi
command -v Xvfb > /dev/null || skip "Xvfb is not installed"
exec 3> "$TMPDIR/display"
Xvfb -displayfd 3 -screen 0 800x600x24 2> /dev/null &
screen=$!
trap 'kill $screen 2> /dev/null' EXIT
for _ in $(seq 50); do [ -s "$TMPDIR/display" ] && break || sleep 0.1; done
[ -s "$TMPDIR/display" ] || skip "Xvfb does not start"
export DISPLAY=:$(cat "$TMPDIR/display") LIBGL_ALWAYS_SOFTWARE=1
timeout 200 blender --factory-startup --python-expr 'import os; os._exit(0)' > /dev/null 2>&1 || skip "Blender opens no window here: no OpenGL 3.3"
timeout 200 blender --factory-startup --enable-event-simulate --no-window-focus -p 0 0 800 600 -P "$here/window.py"
