# A fit of a scan with a hole: once the scale closes the hole, the level follows the outside. It had two sides, and half of its faces inside.
# A box of 2 x 2 x 2, of sheets, with a hole of 0.5 x 0.5 in its bottom.
awk 'BEGIN {
  for (k = 0; k < 8; ++k) print "v", k % 2 * 2, int(k / 2) % 2 * 2, int(k / 4) * 2
  print "v 0.75 0.75 0\nv 1.25 0.75 0\nv 1.25 1.25 0\nv 0.75 1.25 0"
  print "f 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6"
  print "f 2 1 9 10\nf 4 2 10 11\nf 3 4 11 12\nf 1 3 12 9"
}' > scan.obj
facts() { bpinfo "$1" | grep -E '^(triangles|area|volume)'; }
for scale in 0.2 0.3 0.6; do
  bplod scan.obj --mode fit --scale $scale --faces 300 --levels 1 --resolution 64 --up z -q -o "at-$scale" > /dev/null
  said "facts at-$scale/scan.glb"
done
bplod scan.obj --mode fit --scale 0.3 --faces 300 --levels 1 --resolution 64 --up z -q -j 4 -o four > /dev/null
bplod scan.obj --mode fit --scale 0.3 --faces 300 --levels 1 --resolution 64 --up z -q -j 1 --memory 256M -o one > /dev/null
said 'cmp one/scan.glb four/scan.glb'
