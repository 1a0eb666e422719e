# What bpcheck answers: text and exit status for proxies that hold and for those that do not.
write_cube inner.obj 1
sed 's/^v \(.*\) \(.*\) \(.*\)$/echo v $((\1 * 3 - 1)) $((\2 * 3 - 1)) $((\3 * 3 - 1))/e' inner.obj > outer.obj  # -1 to 2
try bpcheck inner.obj outer.obj
try bpcheck outer.obj
try bpcheck outer.obj inner.obj --examples 1 --no-distances
try bpcheck inner.obj inner.obj --examples 1 --no-distances
head -n -1 outer.obj > open.obj
try bpcheck inner.obj open.obj --examples 2 --no-distances
try bpcheck inner.obj outer.obj --json
try bpcheck inner.obj outer.obj --image both.png --image-size 100
try bpcheck inner.obj outer.obj --image both.png --image-size 100
files
