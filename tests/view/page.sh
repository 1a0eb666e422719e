#!/usr/bin/env bash
# The page of bpview in a headless browser: Chromium, but for the test firefox. Leaves pictures.
#   tests/view/page.sh FOLDER [TEST]    FOLDER keeps the installed package and the pictures; the tools are on PATH
#   TEST: page (default): brushed, undone, meshed, saved, reloaded; prints latencies
#         look: what the suite made, shown beside the scene, cut and measured
#         caps: layers that are cut, filled where they are closed
#         keys: all of it but strokes, by the keyboard alone
#         firefox: opened, brushed, undone and saved in Firefox
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
skip() { echo "skipped: $1"; exit 77; }
test=${2:-page}
browser=chromium package=playwright-core@1.65.1
[ "$test" != firefox ] || browser=firefox-esr package=puppeteer-core@24.43.1
run=()
if [ "$test" = firefox ]; then
  command -v xvfb-run > /dev/null || skip "xvfb is not installed"
  run=(env LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s '-screen 0 1400x900x24')
fi
command -v $browser > /dev/null || skip "$browser is not installed"
command -v node > /dev/null && command -v npm > /dev/null || skip "node and npm are not installed"
mkdir -p "$1" && cd "$1"
if [ "$(cat installed 2> /dev/null)" != $package ]; then
  [ -f package.json ] || echo '{"private": true}' > package.json
  timeout 300 npm install --no-audit --no-fund --loglevel=error $package > npm.log 2>&1 || skip "npm cannot install $package: $(tail -1 npm.log)"
  echo $package > installed
fi
rm -rf design && mkdir design
"$here/../../samples/scenes.py" scenes > /dev/null
cp scenes/figure.obj design/
NODE_PATH=$PWD/node_modules exec "${run[@]}" node "$here/$test.cjs" "$PWD/design" figure.obj
