# A --memory below what every run takes: the first refusal names a number that suffices for the whole run, and nothing is written.
# It comes as soon as the number is known: no surface is meshed and no tile closed for it.
# Images count, too: those that are decoded, and those that levels of the scene itself hold.
named() {
  echo "\$ $*"
  "$@" --progress json --memory 10M > out 2> told
  echo "= $?, $(stat -c %s out) bytes on stdout, after: $(grep -o '"pass":"[^"]*' told | cut -d'"' -f4 | uniq | paste -sd, -)"
  grep -v '^{\|: note: ' told > said
  sed 's/[0-9.]* MiB/N MiB/g; s/at least [0-9]*M/at least NM/; s/[0-9]* triangles/N triangles/; s/ [0-9]* x [0-9]* texels/ N texels/; s/^/| /' said
  least=$(grep -o 'at least [0-9]*' said | grep -o '[0-9]*')
  "$@" -q --memory "${least}M" --report r.json > out 2> said || { cat said && return; }
  peak=$(grep -o '"peak_memory_bytes": [0-9]*' r.json | grep -o '[0-9]*$')
  [ "$peak" -le $((least << 20)) ] && echo "done within what was named" || echo "$peak bytes of ${least}M"
  rm -rf lod o.glb o.bpv
}
write_cube cube.obj 3
named bpvox cube.obj -j 1
named bplod cube.obj -o lod -j 2
named bpcheck cube.obj -j 1
# bpmesh shows no progress: what its mesh must enclose lies outside the voxels, which it would find out as the first of its work.
write_octahedron part.obj 1
bpvox cube.obj --resolution 20 --fill none -q -o hollow.bpv
bpmesh hollow.bpv --enclose part.obj -o o.glb -q --memory 10M -j 1 2>&1 | grep -o 'is too little'
bpmesh hollow.bpv --enclose part.obj -o o.glb -q -j 1 2>&1 | grep -o 'does not lie inside the voxels'
rm hollow.bpv
named bplod part.obj --mode fit --faces 40,20 --voxel 0.1 -o lod -j 2
bp-plant --triangles 60000 -o plant.ply > /dev/null
bpvox plant.ply --resolution 500 -q | bpclose --scale 1% -q -o closed.bpv
named bpclose closed.bpv -o o.bpv -j 1
named bpmesh closed.bpv --faces 5000 --enclose plant.ply -o o.glb -j 2
named bplod plant.ply --resolution 100 -o lod -j 1
named bplod plant.ply --resolution 100 --profile occluder --scale 0 --faces 50 -o lod -j 1
named bplod plant.ply --profile 3dtiles --mode visual -o lod -j 1
named bplod plant.ply --resolution 400 --profile 3dtiles -o lod -j 1
named bplod plant.ply --resolution 400 --profile 3dtiles --leaves scene --tile 64 -o lod -j 1
[ "$least" -le 360 ] && echo "triangles count for the tiles that they lie near" || echo "${least}M are named"
rm plant.ply closed.bpv
python3 - << 'PYTHON'
import random, struct, zlib
def png(name, n, seed):
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    noise = random.Random(seed)
    rows = b"".join(b"\0" + noise.randbytes(3 * n) for _ in range(n))
    open(name, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", n, n, 8, 2, 0, 0, 0)) +
                           chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b""))
for i in range(3):
    png(f"{i}.png", 1600, i)
PYTHON
for i in 0 1 2; do printf 'newmtl %s\nmap_Kd %s.png\n' $i $i; done > m.mtl
{ echo mtllib m.mtl; echo vt 0 0; echo vt 1 0; echo vt 0 1; write_octahedron part.obj 4; sed 's/^f \(.\) \(.\) \(.\)/f \1\/1 \2\/2 \3\/3/; 7s/^/usemtl 0\n/; 9s/^/usemtl 1\n/; 12s/^/usemtl 2\n/' part.obj; } > images.obj
named bplod images.obj --mode visual --resolution 32 --faces 8 --levels 1 -o lod -j 1
named bplod images.obj --appearance texture --resolution 32 --faces 20 --levels 1 -o lod -j 1
named bplod images.obj --profile 3dtiles --resolution 128 --tile 64 -o lod -j 2
rm m.mtl [012].png images.obj part.obj cube.obj told said out r.json
files
