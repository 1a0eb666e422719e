#!/usr/bin/env bash
# The page of bpview in headless Chromium. Leaves pictures.
#   tests/view/page.sh FOLDER [TEST]    FOLDER keeps the installed package and the pictures; the tools are on PATH
#   TEST: page (default): brushed, undone, meshed, saved, reloaded; prints latencies
#         look: what the suite made, shown beside the scene, cut and measured
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
skip() { echo "skipped: $1"; exit 77; }
command -v chromium > /dev/null || skip "chromium is not installed"
command -v node > /dev/null && command -v npm > /dev/null || skip "node and npm are not installed"
test=${2:-page}
mkdir -p "$1" && cd "$1"
package=playwright-core@1.65.1
if [ "$(cat installed 2> /dev/null)" != $package ]; then
  [ -f package.json ] || echo '{"private": true}' > package.json
  timeout 300 npm install --no-audit --no-fund --loglevel=error $package > npm.log 2>&1 || skip "npm cannot install $package: $(tail -1 npm.log)"
  echo $package > installed
fi
rm -rf design && mkdir design
"$here/../../samples/scenes.py" scenes > /dev/null
cp scenes/figure.obj design/
NODE_PATH=$PWD/node_modules exec node "$here/$test.cjs" "$PWD/design" figure.obj
