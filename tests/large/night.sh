#!/usr/bin/env bash
# A bad night: twenty scenes, hostile things among them, a full disk at three moments, kill -9 at ten, an empty folder, links. In the end all good scenes
# have levels, and these have the bytes of a machine where nothing happened.
#   tests/large/night.sh     with build/tools and build/samples on PATH; needs root, for a file system of limited size
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'mountpoint -q "$work/disk" && umount "$work/disk"; rm -rf "$work"' EXIT
cd "$work"
options=(--faces 60,20 --resolution 32 -j 1 --time-limit 60s)
bad=0
fail() { echo "FAILED: $*" && bad=1; }
nightly() { "$root/samples/nightly" scenes "$1" "${options[@]}" > "$1.table" 2> "$1.said"; }
levels() { (cd "$1" && find . -mindepth 2 -type f ! -name .begin ! -path './.cache/*' -print0 | LC_ALL=C sort -z | xargs -0 sha256sum); }

mkdir scenes disk
python3 - << 'P'
import math, random
for n in range(20):
    rng, points, faces = random.Random(n), [], []
    for _ in range(3 + n):
        a, s = [rng.uniform(0, 4) for _ in range(3)], [rng.uniform(.2, 1.5) for _ in range(3)]
        base = len(points) + 1
        points += [(a[0] + x * s[0], a[1] + y * s[1], a[2] + z * s[2]) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        faces += [[base + i for i in q] for q in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))]
    with open(f"scenes/good{n:02}.obj", "w") as f:
        f.writelines("v %r %r %r\n" % p for p in points)
        f.writelines("f %d %d %d %d\n" % tuple(q) for q in faces)
P
mv scenes/good07.obj linked.obj && ln -s ../linked.obj scenes/good07.obj

# What a machine makes where nothing happens.
begin=$(date +%s.%N)
nightly quiet || fail "the quiet night ended with $?"
long=$(awk "BEGIN { print $(date +%s.%N) - $begin }")
levels quiet > quiet.sums

# Hostile things among them, one of each kind.
mkfifo scenes/pipe.obj
ln -s /dev/zero scenes/device.ply
ln -s nowhere scenes/broken-link.stl
: > scenes/empty.obj
head -c 300 /dev/urandom > scenes/noise.glb
printf 'v 0 0 0\nv nan 1 1\nv 1 0 0\nf 1 2 3\n' > scenes/nan.obj
printf 'ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n' > scenes/huge.ply
printf '{"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"../pipe"}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]}' > scenes/buffer.gltf
mkfifo pipe
cp scenes/good00.obj $'scenes/a\ttab.obj'
{ echo "mtllib ../pipe"; cat scenes/good01.obj; } > scenes/pipe-of-materials.obj
{ echo "mtllib many.mtl"; cat scenes/good02.obj; } > scenes/many.obj
seq -f 'newmtl m%.0f' 1000000 > scenes/many.mtl
{ printf '{"asset":{"version":"2.0"},"extras":'; head -c 1000000 /dev/zero | tr '\0' '['; } > scenes/deep.gltf
printf '{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[' > scenes/nodes.gltf  # each node has the next one twice
for n in {1..60}; do printf '{"children":[%d,%d]},' "$n" "$n"; done >> scenes/nodes.gltf
printf '{}]}' >> scenes/nodes.gltf
ln -s ../out/good00.obj/good00.glb scenes/output.glb
ln -s /proc scenes/good03.proc && ln -s ../out scenes/good04.out && truncate -s 4T scenes/good05.dat
hostile=$(find scenes -mindepth 1 ! -name 'good*' -printf x | wc -c)
good_in() { tail -n +2 "$1.table" | grep -cE '^good[0-9]*\.obj.(made|same)' || true; }

start=$SECONDS
nightly out && fail "a night with broken scenes must say so" || true
[ "$(good_in out)" = 20 ] || fail "$(good_in out) of 20 good scenes were made among $hostile hostile ones"
echo "among $hostile hostile scenes: $(good_in out) of 20 good ones, $((SECONDS - start)) s"
levels out | grep good > out.sums; cmp out.sums quiet.sums || fail "bytes differ after the hostile night"

# A full disk: from the start, after a few scenes, and when the last ones are written.
for room in 24k 120k 260k; do
  mount -t tmpfs -o "size=$room" tmpfs disk
  nightly disk/out || true
  full=$(good_in disk/out)
  mount -o remount,size=64m disk
  nightly disk/out || true
  [ "$(good_in disk/out)" = 20 ] || fail "after a disk of $room: $(good_in disk/out) of 20"
  levels disk/out | grep good > disk.sums; cmp disk.sums quiet.sums || fail "bytes differ after a full disk of $room"
  echo "a disk of $room: $full of 20 good scenes that night, $(good_in disk/out) the next"
  umount disk
done 2>&1

# kill -9, at ten moments of a night, each with what the last one left.
rm -rf killed
for moment in 1 2 3 4 5 6 7 8 9 10; do
  setsid "$root/samples/nightly" scenes killed "${options[@]}" > /dev/null 2>&1 &
  sleep "$(awk "BEGIN { print $long * $moment / 11 }")"
  kill -9 -- -$! 2> /dev/null || true
  wait $! 2> /dev/null || true
done
nightly killed || true
[ "$(good_in killed)" = 20 ] || fail "after ten kills: $(good_in killed) of 20"
levels killed | grep good > killed.sums; cmp killed.sums quiet.sums || fail "bytes differ after ten kills"
find killed -name '*.partial*' -o -name '.*.new' -o -name '.*.old' | grep . && fail "something half done is left" || true
echo "killed ten times: $(good_in killed) of 20 good scenes"

# Kept tiles that have become pipes, and levels that are gone: what is made of neither has the same bytes.
options+=(--profile 3dtiles)
nightly tiles || true
levels tiles | grep good > tiles.sums
[ "$(good_in tiles)" = 20 ] || fail "$(good_in tiles) of 20 good scenes have tiles"
find tiles/.cache -mindepth 2 -type f | while read -r kept; do rm "$kept" && mkfifo "$kept"; done
find tiles -name tileset.json -exec rm {} +
nightly tiles || true
levels tiles | grep good > again.sums; cmp again.sums tiles.sums || fail "bytes of tiles differ after pipes in the cache"
echo "after pipes in the cache: $(good_in tiles) of 20 good tilesets"
unset 'options[-1]' 'options[-1]'

# A share that is not mounted; damage; a link that leads elsewhere.
mv scenes away && mkdir scenes
nightly out && fail "an empty folder must say so" || true
rmdir scenes && mv away scenes
rm out/good03.obj/*_LOD0.glb && : > out/good04.obj/.key && head -c 30 out/report.tsv > cut && cp cut out/report.tsv
cp scenes/good05.obj other.obj && ln -sf ../other.obj scenes/good07.obj
nightly out || true
[ "$(tail -n +2 out.table | grep -cE '^good0[347]\.obj.made')" = 3 ] || fail "damaged levels and a link that leads elsewhere are not made again"
ln -sf ../linked.obj scenes/good07.obj
nightly out || true
levels out | grep good > out.sums; cmp out.sums quiet.sums || fail "bytes differ in the end"
[ $bad = 0 ] && echo "all good scenes have levels, with the bytes of a quiet machine"
exit $bad
