#!/usr/bin/env bash
# The section OPTIONS of a manual comes from the declarations of the tool's options.
#   tests/options.sh check TOOL MANUAL     prints what differs; exit 1 if something does
#   tests/options.sh write TOOL MANUAL     rewrites the section
# TOOL: the program itself, or its name on PATH. MANUAL: Markdown with a heading "# OPTIONS".
set -euo pipefail
how=$1 tool=$2 manual=$3
made=$(mktemp)
trap 'rm -f "$made"' EXIT
grep -qx '# OPTIONS' "$manual" || { echo "$manual: has no heading '# OPTIONS'"; exit 1; }
{
  sed '/^# OPTIONS$/q' "$manual"
  echo
  "$tool" --help markdown
  echo
  awk 'after && /^# / { on = 1 } /^# OPTIONS$/ { after = 1 } on' "$manual"
} > "$made"
if [ "$how" = write ]; then
  cat "$made" > "$manual"
else
  diff -u --label "$manual" --label "$(basename "$tool") --help markdown" "$manual" "$made"
fi
