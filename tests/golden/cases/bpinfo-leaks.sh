# Where buildings are open: bpinfo --leaks.
# Each line NAME X0 Y0 Z0 X1 Y1 Z1 becomes a box.
write_boxes() {
  awk '{
    print "o " $1
    for (i = 0; i < 8; ++i) print "v", $(i % 2 ? 5 : 2), $(int(i / 2) % 2 ? 6 : 3), $(i > 3 ? 7 : 4)
    n = split("1 3 4 2 5 6 8 7 1 2 6 5 3 7 8 4 1 5 7 3 2 4 8 6", f)
    for (i = 1; i <= n; i += 4) print "f", f[i] + b, f[i + 1] + b, f[i + 2] + b, f[i + 3] + b
    b += 8
  }' > "$1"
}
# 12 x 6 x 8, walls 0.25 thick, an upper floor at 3 with a hole of 0.5 x 1, a door of 1 x 2.
write_boxes house.obj << 'END'
floor 0 0 0 12 0.25 8
roof 0 5.75 0 12 6 8
west 0 0 0 0.25 6 8
east 11.75 0 0 12 6 8
north 0 0 0 12 6 0.25
south 0 0 7.75 6 6 8
south 7 0 7.75 12 6 8
south 6 2.25 7.75 7 6 8
deck 0 3 0 2 3.25 8
deck 2.5 3 0 12 3.25 8
deck 2 3 0 2.5 3.25 2
deck 2 3 3 2.5 3.25 8
END
try bpinfo --leaks house.obj --resolution 240
try bpinfo --leaks house.obj --voxel 0.05 --json
said 'bpvox house.obj --resolution 240 --fill none | bpinfo --leaks'
said 'bpvox house.obj --resolution 240 | bpclose --scale 0.3 | bpinfo --leaks'
said 'bpvox house.obj --resolution 240 | bpclose --scale 0.6 | bpinfo --leaks'
try bpinfo --leaks house.obj --resolution 60 --image house.png -q > /dev/null
head -c 4 house.png | tail -c 3; echo
try bpinfo --leaks house.obj --up -y --resolution 60
# A slit as wide as a voxel in the roof, and no floor.
write_boxes slit.obj << 'END'
roof 0 3.9 0 5 4 4
roof 5.1 3.9 0 10 4 4
roof 5 3.9 0 5.1 4 1
roof 5 3.9 3 5.1 4 4
west 0 0 0 0.1 4 4
east 9.9 0 0 10 4 4
north 0 0 0 10 4 0.1
south 0 0 3.9 10 4 4
END
try bpinfo --leaks slit.obj --voxel 0.04
write_cube cube.obj
try bpinfo --leaks cube.obj --resolution 20
try bpinfo --leaks house.obj cube.obj
try bpinfo --leaks house.obj --boxes deck
try bpinfo --leaks house.obj --voxel 0.1 --resolution 10
try bpinfo --leaks house.obj --memory 64M -j 1 --resolution 1000
# What does not fit is refused before the work, with the least number that suffices.
for memory in 10M 64M; do
  bpinfo --leaks house.obj --memory $memory -j 1 --resolution 240 > told 2> said; echo "= $?, $(stat -c %s told) bytes on stdout"
  least=$(grep -o 'at least [0-9]*' said | grep -o '[0-9]*')
  bpinfo --leaks house.obj --memory "${least}M" -j 1 --resolution 240 | head -1
  bpinfo --leaks house.obj --memory "$((least - 1))M" -j 1 --resolution 240 2>&1 > told | grep -q "at least $least MiB" && echo "no smaller one is named"
done
bpvox house.obj --resolution 600 --fill none -q > big.bpv
head -c 3000 big.bpv > cut.bpv
said 'bpinfo --leaks --memory 64M -j 1 < cut.bpv' | sed 's/[0-9]* MiB/N MiB/g'
said 'bpinfo --leaks < cut.bpv' | sed 's/[0-9]* bytes/N bytes/g'
rm told said big.bpv cut.bpv
try bpinfo house.obj --resolution 10
said 'bpvox house.obj --resolution 60 | bpinfo --leaks --voxel 1'
said 'bpvox house.obj --resolution 60 --fill inside | bpinfo --leaks'
said 'bpinfo --leaks --format obj --resolution 60 --image x.png < house.obj'
# What an occluder holds must be enough, or the message names the leak.
try bplod house.obj --profile occluder --resolution 120 --scale 0.2 --min-hidden 50% -o out
try bplod house.obj --profile occluder --resolution 120 --scale 0.52 --min-hidden 50% --report report.json -q -o out
grep -oE '"(closed_gap|min_hidden)": [0-9.]*' report.json
try bplod house.obj --profile occluder --min-hidden 5 -o out
try bplod house.obj --min-hidden 5% -o out
try bplod slit.obj --profile occluder --scale 0 --voxel 0.04 -o slit
files
