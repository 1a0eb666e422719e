# Each tool's --help and its manual name the same options, in the same order.
for tool in bpvox bpclose bpmesh bpcheck bpinfo bplod; do
  command -v $tool > /dev/null || { echo "$tool: missing"; continue; }
  $tool --version | sed 's/+[0-9a-f]\{16\}$/+DIGEST/'
  $tool --help | sed -n 's/^  \(\(-\|\[*[A-Z][A-Z]\)[^ ]*\( [^ ]\+\)*\).*/\1/p' | grep -v "^$tool" > options.help
  sed -n 's/^- `\([^`]*\)`.*/\1/p' "$BP_ROOT/docs/$tool.1.md" > options.manual
  diff options.help options.manual && echo "$tool: $(wc -l < options.help) options"
  $tool --help | awk -v t=$tool '/^Example/ { exit } length > 80 { print t ": too long: " $0 }'
  [ "$($tool -h)" = "$($tool --help)" ] || echo "$tool: -h differs"
done
