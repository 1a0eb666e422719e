# Nothing that a run reads is replaced or removed by it, whatever it is called; nor is what somebody else wrote meanwhile.
write_octahedron cube.obj 3
options=(--name m --resolution 24 --levels 1 --faces 20 -q)
sums() { (cd "$1" && find . -type f | LC_ALL=C sort | xargs cksum); }

# A buffer of the input is a tile of the tileset that was there before: it stays.
bpvox cube.obj --resolution 24 | bpmesh --faces 20 -q -o scene.gltf
mkdir T
sed 's|"uri":"data:[^"]*"|"uri":"ext.bin"|; s|"uri": "data:[^"]*"|"uri": "ext.bin"|' scene.gltf > T/ext.gltf
grep -o 'base64,[^"]*' scene.gltf | head -1 | cut -c 8- | base64 -d > T/ext.bin
cat > T/tileset.json << JSON
{"asset": {"version": "1.1"}, "geometricError": 1, "root": {"boundingVolume": {"box": [0,0,0,9,0,0,0,9,0,0,0,9]},
 "geometricError": 0, "refine": "REPLACE", "content": {"uri": "ext.bin"}}}
JSON
cksum T/ext.* > before
bplod T/ext.gltf -o T "${options[@]}" --profile 3dtiles --overwrite | cut -f 1
cksum T/ext.* | diff before - && LC_ALL=C ls -A T

# A scene by another name is an input, too.
ln cube.obj hard.ply
ln -s cube.obj soft.ply
try bpvox cube.obj --resolution 24 -o cube.bpv
ln cube.bpv hard.bpv
for name in hard.ply soft.ply; do
  try bpmesh cube.bpv --enclose cube.obj --faces 20 -o $name --overwrite
done
try bpclose cube.bpv --scale 1vx -o hard.bpv --overwrite
try bpclose cube.bpv --scale 1vx -o ./cube.bpv --overwrite
stdin=cube.bpv try bpclose --scale 1vx -o cube.bpv --overwrite
ln cube.obj hard.png
try bpinfo cube.obj --image hard.png --overwrite
mkdir -p T2/.partial/results
cp cube.obj T2/.partial/results/s.obj
try bplod T2/.partial/results/s.obj -o T2 "${options[@]}" --profile 3dtiles --overwrite
ls T2/.partial/results

# Without --overwrite, a file that appears meanwhile stays, and the run says so.
wait_for() { for ((k = 0; k < 400; ++k)); do [ -e "$1" ] && return; sleep 0.02; done; }
mkfifo in
bpclose - --scale 1vx -o late.bpv < in 2> said & 
exec 3> in
head -c 100 cube.bpv >&3
wait_for late.bpv.partial-1
echo precious > late.bpv
tail -c +101 cube.bpv >&3
exec 3>&-
wait $!
echo "= $?"
cat said late.bpv

# Two at one output: the first one that ends has it.
bpclose - --scale 1vx -o one.bpv < in 2> said &
exec 3> in
head -c 100 cube.bpv >&3
wait_for one.bpv.partial-1
bpclose cube.bpv --scale 1vx -o one.bpv
cksum one.bpv > before
tail -c +101 cube.bpv >&3
exec 3>&-
wait $!
echo "= $?"
cat said
cksum one.bpv | diff before - && echo "the first one stays"

# The same of folders: no new file of an unfinished set stays.
for profile in gltf 3dtiles; do
  late=m.glb
  [ $profile = gltf ] || late=tileset.json
  bplod - --format obj "${options[@]}" --profile $profile -o $profile < in > list 2> said &
  exec 3> in
  head -c 20 cube.obj >&3
  [ $profile = gltf ] && wait_for gltf/m.glb.partial-1 || wait_for 3dtiles/.partial
  echo precious > $profile/$late
  tail -c +21 cube.obj >&3
  exec 3>&-
  wait $!
  echo "= $?"
  cat said $profile/$late
  find $profile | LC_ALL=C sort
done
files
