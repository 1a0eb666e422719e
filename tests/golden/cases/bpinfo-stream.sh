# What bpinfo says of the stream that docs/brick-stream.md prints in hexadecimal, whole and broken.
sed -n '/^## 12/,$p' "$BP_ROOT/docs/brick-stream.md" | sed -n '/^```$/,/^```$/p' | grep -v '```' | cut -c7- |
  while read -r line; do printf "$(printf '\\x%s' $line)"; done > one.bpv
try bpinfo one.bpv
try bpinfo one.bpv --json
try bpinfo one.bpv --dump
said 'bpinfo one.bpv | checksum'
said 'bpinfo < one.bpv | checksum'
said 'bpinfo one.bpv --image one.png | checksum'
try bpinfo one.bpv --image one.png
head -c 8 one.png | tail -c 7 | head -c 3; echo
head -c 300 one.bpv > cut.bpv
try bpinfo cut.bpv
head -c 400 one.bpv | stdin=/dev/stdin try bpinfo --dump
(cat one.bpv; echo) > tail.bpv
try bpinfo tail.bpv
(head -c 270 one.bpv; printf '\x29'; tail -c +272 one.bpv) > flip.bpv
try bpinfo flip.bpv
try bpinfo one.png
stdin=one.png try bpinfo
: > empty
try bpinfo empty
try bpinfo missing.bpv
try bpinfo one.bpv --json --dump
files
