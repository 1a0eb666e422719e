#!/usr/bin/env bash
# Runs clang-tidy (.clang-tidy) on sources that changed.
#   tests/tidy.sh BUILD [COMMIT | --all]
# BUILD has compile_commands.json. Sources that differ from COMMIT, uncommitted changes included; without COMMIT, from where the branch left
# main; on main, what the last commit or merge has changed. A changed header stands for the source of its name. BP_TIDY_MOST: only so many of
# them, spread evenly, for continuous integration. Exit status 1 if there is a finding.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(cd "$1" && pwd)
cd "$root"
tidy=$(command -v clang-tidy-14 || command -v clang-tidy || true)
if [ -z "$tidy" ] || [ ! -e "$build/compile_commands.json" ] || ! git rev-parse -q --verify HEAD^ > /dev/null 2>&1; then
  echo "SKIPPED: needs clang-tidy, a configured build and a clone with a history"
  exit 0
fi

base() {
  local main fork
  for main in origin/main main; do
    fork=$(git merge-base HEAD "$main" 2> /dev/null) || continue
    [ "$fork" = "$(git rev-parse HEAD)" ] || { echo "$fork"; return; }
  done
  echo HEAD^
}

changed() {
  if [ "${2:-}" = --all ]; then git ls-files; else git diff --name-only --diff-filter=d "${2:-$(base)}"; fi |
    sed -n -E 's#^((lib|io|tools)/.*)\.(h|cpp)$#\1.cpp#p' | sort -u | while read -r source; do [ ! -e "$source" ] || echo "$source"; done
}

mapfile -t sources < <(changed "$@")
most=${BP_TIDY_MOST:-0} all=${#sources[@]}
if [ "$most" -gt 0 ] && [ "$all" -gt "$most" ]; then
  mapfile -t sources < <(printf '%s\n' "${sources[@]}" | awk -v all="$all" -v most="$most" 'int(NR * most / all) > int((NR - 1) * most / all)')
fi
[ "${#sources[@]}" -gt 0 ] || { echo "no source has changed"; exit 0; }
echo "${#sources[@]} of $all changed sources"
printf '%s\n' "${sources[@]}" | xargs -P "$(nproc)" -n 1 "$tidy" -p "$build" --quiet 2> /dev/null
