# Tilesets from what an earlier build made: the same bytes as from nothing, whatever is in the cache.
for i in 0 1 2; do
  write_cube cube.obj 3
  sed "s/^v \(.*\) \(.*\) \(.*\)$/echo v \$((\1 + 7 * $i)) \2 \$((\3 + $i))/e" cube.obj > part$i.obj
done
options=(part*.obj --name cubes --voxel 0.025 --tile 256 --profile 3dtiles -q)
build() { bplod "${options[@]}" "$@" > list; }
build -o whole
build -o first --cache cache --report first.json
build -o second --cache cache --report second.json -j 1
diff -r whole first && diff -r whole second && echo "the same bytes"
kept first.json
kept second.json
find cache -mindepth 2 -type f | head -1 | while read -r f; do echo damaged > "$f"; done
build -o second --cache cache --overwrite
diff -r whole second && echo "the same bytes in spite of damage"

# One part moves: few tiles are made anew.
sed -i 's/^v \(.*\) 3 \(.*\)$/v \1 2 \2/' part2.obj
build -o moved --cache cache --report moved.json
build -o from-nothing
diff -r moved from-nothing && echo "the same bytes"
kept moved.json

# Killed at some moment: the same command goes on from the cache.
for after in 0.05 0.2 0.4; do
  bplod "${options[@]}" -o resumed --cache killed --overwrite > list & job=$!
  sleep $after
  kill -9 $job 2> /dev/null
  wait $job 2> /dev/null
done 2> /dev/null
build -o resumed --cache killed --overwrite
diff -r resumed from-nothing && echo "the same bytes"
ls -A resumed | grep partial
# A disk that is full, and too little memory, are said; nothing stays behind.
full() { (ulimit -f 1; "$@"); }
try full bplod "${options[@]}" -o x --cache small-cache | sed 's/x.\.partial.*glb/FILE/; s/small-cache.[0-9a-f]*.[0-9a-f]*/FILE/'
try full bplod "${options[@]}" -o x | sed 's/x.\.partial.*glb/FILE/'
ls -d x 2> /dev/null
# Results of another build cannot be used: that is said, once, and not when this build's are there, too.
mkdir -p other/ab empty
touch other/ab/cdef other/made-by-0123456789abcdef
for cache in empty other cache; do
  bplod "${options[@]}" --explain --cache $cache --overwrite --report explained.json > list
  grep -oE "$cache: holds[^\"]*" explained.json || echo "nothing is said of $cache"
done
build -o from-other --cache other --report from-other.json
grep -o 'other: holds[^"]*' from-other.json
diff -r from-other from-nothing && echo "the same bytes"
build -o from-other --overwrite --cache other --report from-other.json
grep -o 'other: holds[^"]*' from-other.json || echo "nothing is said any more"
# What takes long is told before it is made: not what is kept, and of the rest its share.
for high in 5 5 6; do
  awk -v high=$high 'BEGIN { for (i = 0; i < 16; ++i) {
    for (k = 0; k < 8; ++k) print "v", i % 4 * 10 + k % 2 * 9, int(k / 2) % 2 * (i == high ? 2 : 1), int(i / 4) * 10 + int(k / 4) * 9
    split("1 3 4 2 5 6 8 7 1 2 6 5 3 7 8 4 1 5 7 3 2 4 8 6", f)
    for (k = 1; k < 25; k += 4) print "f", f[k] + 8 * i, f[k + 1] + 8 * i, f[k + 2] + 8 * i, f[k + 3] + 8 * i } }' > long.obj
  BP_BACKEND=cpu bplod long.obj --profile 3dtiles --voxel 0.08 --tile 128 -j 1 --cache long -o long-tiles --overwrite --report long.json -q > list
  grep -o 'a grid of .* about' long.json || echo "no time is told"
done
rm -r long long.obj long-tiles long.json
# The same voxels of more triangles: a level begins elsewhere, and is none of those that are kept.
for times in 1 400; do
  awk -v times=$times 'BEGIN {
    split("-3.588 -6.375 -1.744 5.224 1.047 -5.308 -7.263 -0.244 1.938 1.550 7.178 -1.626 -1.550 -7.178 1.626 7.263 0.244 -1.938 -5.224 -1.047 5.308 3.588 6.375 1.744", p)
    for (k = 1; k < 25; k += 3) print "v", p[k], p[k + 1], p[k + 2]
    split("1 3 4 2 5 6 8 7 1 2 6 5 3 7 8 4 1 5 7 3 2 4 8 6", f)
    for (i = 0; i < times; ++i) for (k = 1; k < 25; k += 4) print "f", f[k], f[k + 1], f[k + 2], f[k + 3] }' > turned.obj
  bplod turned.obj --enclose input --profile 3dtiles --voxel 0.05 --tile 128 --faces 2000,500,80 --cache turned -q -o turned-$times > list
done
bplod turned.obj --enclose input --profile 3dtiles --voxel 0.05 --tile 128 --faces 2000,500,80 -q -o turned-new > list
diff -r turned-400 turned-new && echo "the same bytes"
diff -rq turned-1 turned-new > list || echo "others than of fewer triangles"
rm -r turned turned.obj turned-1 turned-400 turned-new
try bplod part0.obj -o x --cache cache
try bplod part0.obj -o x --resume --profile 3dtiles
try bplod part0.obj -o x --profile 3dtiles --cache part0.obj/cache
files
