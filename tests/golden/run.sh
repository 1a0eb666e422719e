#!/usr/bin/env bash
# Golden tests of the command line. A case is a script cases/NAME.sh beside what it must print: NAME.stdout, NAME.stderr
# and NAME.exit (absent: nothing, and 0). It runs in a fresh folder, with the tools on PATH and helpers.sh at hand. A case that
# cannot run here prints why, and exits with 77.
#   tests/golden/run.sh [--accept] [NAME...]      all cases without NAME; --accept writes what was printed as the truth
# The tools are looked for in BP_BIN (folders, separated by colons), else in build/release.
set -u
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
: "${BP_BIN:=$root/build/release/tools:$root/build/release/samples}"
bin=
IFS=: read -ra folders <<< "$BP_BIN"
for one in "${folders[@]}"; do bin+=$(cd "$one" && pwd): || exit 1; done  # cases run elsewhere
export PATH="$bin$PATH" LC_ALL=C BP_ROOT=$root
unset TMPDIR BP_BACKEND
accept=false
if [ "${1:-}" = --accept ]; then
  accept=true
  shift
fi
if [ $# = 0 ]; then
  for case in "$here"/cases/*.sh; do set -- "$@" "$(basename "$case" .sh)"; done
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# The folder's name differs each time; in texts it is called FOLDER. The version, which CMakeLists.txt alone names, is called VERSION.
version=$(sed -n 's/^project(.* VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
plain() { sed -E -e "s|$folder/run|FOLDER|g" -e "s/\b(bp[a-z]+ |\"version\": \")${version//./\\.}\b/\1VERSION/g" "$1"; }

failed=0
for name in "$@"; do
  rm -rf "$folder"/*
  mkdir "$folder/run"
  (cd "$folder/run" && exec bash -c 'source "$1"; source "$2"' golden "$here/helpers.sh" "$here/cases/$name.sh") \
    > "$folder/stdout" 2> "$folder/stderr" < /dev/null
  status=$?
  [ $status != 77 ] || { echo "skipped $name: $(cat "$folder/stdout")" && continue; }
  [ $status = 0 ] && : > "$folder/exit" || echo $status > "$folder/exit"
  ok=true
  for kind in stdout stderr exit; do
    plain "$folder/$kind" > "$folder/got"
    truth=$here/cases/$name.$kind
    if $accept; then
      if [ -s "$folder/got" ]; then cp "$folder/got" "$truth"; else rm -f "$truth"; fi
    else
      [ -f "$truth" ] || truth=/dev/null
      diff -u --label "$name.$kind: expected" --label "$name.$kind: got" "$truth" "$folder/got" || ok=false
    fi
  done
  if $ok; then echo "ok $name"; else failed=$((failed + 1)); fi
done
[ $failed = 0 ] || { echo "$failed failed; if the new output is right: tests/golden/run.sh --accept NAME"; exit 1; }
