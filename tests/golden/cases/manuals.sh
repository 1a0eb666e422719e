# The section OPTIONS of each manual is what `TOOL --help markdown` prints; tests/options.sh rewrites it.
tools="bpvox bpscale bpclose bpmesh bpcheck bpinfo bplod bpdeform"
command -v bpview > /dev/null && tools+=" bpview" # a build without cpp-httplib has none
for tool in $tools; do
  command -v $tool > /dev/null || { echo "$tool: missing"; continue; }
  [ $tool = bpview ] || $tool --version | sed 's/+[0-9a-f]\{16\}$/+DIGEST/'
  bash "$BP_ROOT/tests/options.sh" check $tool "$BP_ROOT/docs/$tool.1.md"
  $tool --help > short
  [ $(wc -l < short) -le 31 ] || echo "$tool: --help has $(wc -l < short) lines"
  [ "$($tool -h)" = "$(cat short)" ] || echo "$tool: -h differs"
  for help in '' all; do
    $tool --help $help | awk -v t=$tool '/^Example/ { exit } length > 80 { print t ": too long: " $0 }'
  done
done
rm short
# A man page fits 80 columns, and names no page that is not there.
if command -v pandoc > /dev/null && command -v mandoc > /dev/null; then
  for tool in $tools; do
    pandoc -s -f markdown-smart -t man -M docs=/doc -L "$BP_ROOT/cmake/man.lua" "$BP_ROOT/docs/$tool.1.md" -o page
    mandoc -T utf8 -O width=78 page | col -bx > shown
    awk -v t=$tool 'length > 80 { print t ".1: too long: " $0 }' shown
    mandoc -T utf8 -O width=900 page | col -bx | grep -oE '[a-z0-9/-]+\.md' | sort -u | while read -r page; do
      [ -e "$BP_ROOT/docs/$page" ] || echo "$tool.1: $page is not there"
    done
    rm page shown
  done
fi
try bpvox --faces 100 scene.obj
try bpvox --face 100 scene.obj
try bpclose --resolution 64
try bpmesh --help=nothing
