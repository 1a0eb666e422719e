# Small parts are left out of a proxy inside, and the note says so.
write_cube cube.obj 20
{ cat cube.obj; sed -n 's/^v \(.*\) \(.*\) \(.*\)$/\1 \2 \3/p' cube.obj | awk '{ print "v", 25 + $1 / 10, $2 / 10, $3 / 10 }'
  awk '$1 == "f" { printf "f"; for (i = 2; i <= NF; ++i) printf " %d", $i + 8; print "" }' cube.obj; } > two.obj
bpvox two.obj --resolution 108 --fill inside -q | bpclose --scale 0 -q -o inner.bpv
try bpmesh inner.bpv --mode inside --faces 100 -o one.ply --report one.json
bpcheck --inside two.obj one.ply | sed -n '1p;$p'
# What keeps it from the faces wanted, and what helps, is that of an opening.
some() { sed -E 's/(tries refused: ).*/\1SOME)/'; }
try bpmesh inner.bpv --faces 2 -o few.ply | some
rm few.ply
said 'bpvox two.obj --resolution 54 --fill inside -q | bpclose --scale 0.5vx > /dev/null'
grep -E '"(parts|voxels)_dropped"' one.json
files
