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
# An option of another tool of the pipe: the message says whose it is.
for tool in bpvox bpclose bpmesh bpcheck bpinfo bplod; do
  $tool --help | grep -oE '^  (-., )?--[a-z-]+' | grep -oE -e '--[a-z-]+' | sed "s/^/$tool /"
done > options
cut -d ' ' -f 2 options | sort -u | while read -r option; do
  for tool in bpvox bpclose bpmesh bpcheck bpinfo bplod; do
    grep -qx -e "$tool $option" options && continue
    said=$($tool $option 2>&1)
    for other in $(sed -n "s/ $option\$//p" options); do
      [[ $said == *"; $option is an option of "*"$other"* ]] || echo "$tool $option: does not name $other: $said"
    done
  done
done
try bpvox --faces 100 scene.obj
try bpvox --face 100 scene.obj
try bpclose --resolution 64
