# Cages: nothing but quads around a scene, which keep a margin from it, and are its mirror image if it is.
block() {  # FROM TO, of a file that has so many vertices already
  awk -v f="$1" -v t="$2" -v n="$3" 'BEGIN { split(f, a, ","); split(t, b, ",")
    for (i = 0; i < 8; ++i) print "v", (i % 2 ? b[1] : a[1]), (int(i / 2) % 2 ? b[2] : a[2]), (i > 3 ? b[3] : a[3])
    split("0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3 0 4 6 2 1 3 7 5", c)
    for (i = 1; i <= 24; i += 4) print "f", n + c[i] + 1, n + c[i + 1] + 1, n + c[i + 2] + 1, n + c[i + 3] + 1 }'
}
{ block 0,0,4 12,5,10 0; block 1,1,0 4,4,4.5 8; block 8,1,0 11,4,4.5 16; } > legs.obj
{ cat legs.obj; block 2,2,9.5 4,3,14 24; } > horn.obj
mirrored() {  # FILE AXIS (1: x), across the middle of the cage: vertices without an image
  awk -v a="$2" -v n=0 'function key() { return sprintf("%.6f %.6f %.6f", c[1] + 0, c[2] + 0, c[3] + 0) }
    /^v/ { for (i = 1; i <= 3; ++i) c[i] = v[n, i] = $(i + 1); p[key()] = 1
      if (!n++ || c[a] < lo) lo = c[a]; if (n == 1 || c[a] > hi) hi = c[a] }
    END { for (k = 0; k < n; ++k) { for (i = 1; i <= 3; ++i) c[i] = v[k, i]; c[a] = lo + hi - c[a]; bad += !(key() in p) }
      print bad + 0 " of " n " vertices without an image" }' "$1"
}
small() { bplod "$@" --profile cage --up z --faces 300 --resolution 64 -q --overwrite | cut -f 1; }

small legs.obj -o legs
bpcheck --margin 0.08 legs.obj legs/legs_cage.obj | grep -e quads -e margin -e encloses -e holds | sed 's/:.*quads.*/: quads/'
mirrored legs/legs_cage.obj 1
bpcheck legs.obj legs/legs_cage.glb | tail -1
small legs.obj -o legs1 -j 1 --memory 100M
diff -r legs legs1 && echo "the same bytes"
small legs.obj -o wide --margin 1
bpcheck --margin 1 legs.obj wide/legs_cage.obj | tail -1
bpcheck --margin 3 legs.obj wide/legs_cage.obj | grep margin
for margin in 0.5% 20% 100%; do bpcheck --margin $margin legs.obj legs/legs_cage.obj | grep -e keeps -e least.dist; done

# The most is taken, whatever is rounded.
printf '%s\n' 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'v 0 0 1' 'f 1 3 2' 'f 1 2 4' 'f 1 4 3' 'f 2 3 4' > corner.obj
small corner.obj -o corner --margin 20%
bpcheck --margin 20% corner.obj corner/corner_cage.obj | tail -1

# What is no mirror image gets another cage, unless it is told to.
small horn.obj -o horn
mirrored horn/horn_cage.obj 1 | sed 's/^[1-9][0-9]*/some/'
small horn.obj -o even --symmetry x
mirrored even/horn_cage.obj 1
bpcheck horn.obj even/horn_cage.obj | tail -1

# Limbs that grow together are named; with more faces they stay apart.
{ block 0,0,9 31,1,10 0; for i in 0 1 2 3 4 5 6 7; do block "$((4 * i)),0,0" "$((4 * i + 1)),1,9" "$((8 * i + 8))"; done; } > comb.obj
for faces in 40 500; do
  bplod comb.obj --profile cage --up z --faces $faces --resolution 128 --overwrite -o comb 2>&1 | grep limbs || echo "none of $faces faces"
done

try bplod legs.obj --profile cage --margin 10 -o x
try bplod legs.obj --profile cage --faces 11 -o x
try bplod legs.obj --profile cage --scale 2% -o x
try bplod legs.obj --profile collision --margin 1% -o x
try bpcheck --margin 1 --inside legs.obj legs/legs_cage.obj
try bpcheck --margin 1vx legs.obj legs/legs_cage.obj
try bpcheck --margin 1 legs/legs_cage.obj
