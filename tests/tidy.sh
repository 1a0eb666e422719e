#!/usr/bin/env bash
# Runs clang-tidy (.clang-tidy) on sources that changed, and lists what it finds in the changed lines.
#   tests/tidy.sh BUILD [COMMIT | --all]
# BUILD has compile_commands.json. Lines that differ from COMMIT, uncommitted changes included; without COMMIT, from where the branch left
# main; on main, what the last commit or merge has changed. A header goes with the source of its name. --all: all lines of all sources.
# BP_TIDY_MOST: only so many sources, spread evenly, for continuous integration. Exit status 1 if there is a finding.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(cd "$1" && pwd)
since=${2:-}
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
  if [ "$since" = --all ]; then git ls-files; else git diff --name-only --diff-filter=d "$since"; fi |
    sed -n -E 's#^((lib|io|tools)/.*)\.(h|cpp)$#\1.cpp#p' | sort -u | while read -r source; do [ ! -e "$source" ] || echo "$source"; done
}

# The changed lines of a source and its header, as --line-filter takes them.
lines_of() {
  git diff -U0 --diff-filter=d "$since" -- "$1" "${1%.cpp}.h" | awk '
    /^\+\+\+ b\// { file = substr($2, 3) }
    /^@@/ { n = split(substr($3, 2), at, ","); many = n > 1 ? at[2] : 1
            if (many > 0) ranges[file] = ranges[file] (ranges[file] ? "," : "") "[" at[1] "," at[1] + many - 1 "]" }
    END { for (file in ranges) all = all (all ? "," : "") "{\"name\":\"" file "\",\"lines\":[" ranges[file] "]}"; print "[" all "]" }'
}

# Where a room is compiled as one, its sources have no commands of their own, and clang-tidy would guess them from another target's.
# This writes BUILD/tidy/compile_commands.json, in which each source has the command of the file that includes it.
own_commands() {
  mkdir -p "$build/tidy"
  python3 - "$build" << 'END'
import json, re, shlex, sys
commands = []
for entry in json.load(open(f"{sys.argv[1]}/compile_commands.json")):
    words = shlex.split(entry["command"])
    sources = re.findall(r'^#include "(.*\.cpp)"', open(entry["file"]).read(), re.M) if "/Unity/" in entry["file"] else [entry["file"]]
    for source in sources:
        arguments = [source if word == entry["file"] else word for word in words]
        commands.append({"directory": entry["directory"], "file": source, "arguments": arguments})
json.dump(commands, open(f"{sys.argv[1]}/tidy/compile_commands.json", "w"))
END
}

look_at() {
  if [ "$since" = --all ]; then "$tidy" -p "$build/tidy" --quiet "$1"; else "$tidy" -p "$build/tidy" --quiet --line-filter="$(lines_of "$1")" "$1"; fi 2> /dev/null
}

[ -n "$since" ] || since=$(base)
mapfile -t sources < <(changed)
most=${BP_TIDY_MOST:-0} all=${#sources[@]}
if [ "$most" -gt 0 ] && [ "$all" -gt "$most" ]; then
  mapfile -t sources < <(printf '%s\n' "${sources[@]}" | awk -v all="$all" -v most="$most" 'int(NR * most / all) > int((NR - 1) * most / all)')
fi
[ "${#sources[@]}" -gt 0 ] || { echo "no source has changed"; exit 0; }
echo "${#sources[@]} of $all changed sources"
own_commands
export -f look_at lines_of
export tidy build since
printf '%s\n' "${sources[@]}" | xargs -P "$(nproc)" -n 1 bash -c 'look_at "$1"' _
