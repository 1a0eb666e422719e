# What describes a scene, or is read as a whole, is counted before it is there: the line names the --memory that will do.
limit=64M
named() {
  echo "\$ $*"
  "$@" -j 1 --memory "$limit" 2> said > out
  echo "= $?"
  sed 's/[0-9.]* MiB/N MiB/g; s/^/| /' said
  local again=--overwrite
  [ "$1" = bpcheck ] && again=
  least=$(grep -o 'to at least [0-9]*' said | grep -o '[0-9]*')
  "$@" -j 1 --memory "${least}M" --report r.json $again 2> said > out
  grep 'to at least' said && return
  peak=$(grep -o '"peak_memory_bytes": [0-9]*' r.json | grep -o '[0-9]*$')
  [ "$peak" -le $((least << 20)) ] && echo "done within what was named" || echo "$peak bytes of ${least}M"
}
awk -v n=100000 'BEGIN {
  printf "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0"
  for (i = 1; i < n; ++i) printf ",%d", i
  printf "]}],\"nodes\":[{\"mesh\":0}"
  for (i = 1; i < n; ++i) printf ",{\"mesh\":0,\"translation\":[%d,%d,0]}", i % 300, i / 300
  printf "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
  printf "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}"
}' > nodes.gltf
named bpvox nodes.gltf --resolution 100 -o o.bpv
named bplod nodes.gltf --resolution 100 --faces 500 --up z -o lod
named bplod nodes.gltf --resolution 100 --profile 3dtiles --up z -o tiles
bpvox nodes.gltf --resolution 100 -q -o nodes.bpv
named bpmesh nodes.bpv --faces 500 --enclose nodes.gltf -o o.ply
# Scenes are opened one after the other, beside the proxy, and beside what is kept of the scenes before.
printf 'v %d %d %d\n' -1 -1 -1 400 -1 -1 400 400 -1 -1 400 -1 -1 -1 2 400 -1 2 400 400 2 -1 400 2 > box.obj
printf 'f %d %d %d %d\n' 1 4 3 2 5 6 7 8 1 2 6 5 2 3 7 6 3 4 8 7 4 1 5 8 >> box.obj
named bpcheck nodes.gltf box.obj
named bpcheck nodes.gltf nodes.gltf box.obj
named bpcheck nodes.gltf tiles/tileset.json
rm -r lod tiles nodes.bpv box.obj o.ply
# An animation: each cage is a morph target of each part.
awk -v n=2000 'BEGIN {
  printf "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0"
  for (i = 1; i < n; ++i) printf ",%d", i
  printf "]}],\"nodes\":[{\"mesh\":0}"
  for (i = 1; i < n; ++i) printf ",{\"mesh\":%d}", i
  printf "],\"meshes\":["
  for (i = 0; i < n; ++i) printf "%s{\"primitives\":[{\"attributes\":{\"POSITION\":%d}}]}", i ? "," : "", i
  printf "],\"accessors\":["
  for (i = 0; i < n; ++i) printf "%s{\"bufferView\":0,\"byteOffset\":%d,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}", i ? "," : "", 36 * i
  printf "],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d}],\"buffers\":[{\"byteLength\":%d,\"uri\":\"data:;base64,", 36 * n, 36 * n
  for (i = 0; i < n; ++i) printf "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
  print "\"}]}"
}' > parts.gltf
write_cube cage.obj 4
bpdeform bind parts.gltf cage.obj -o parts.bpw --outside near -q
limit=80M
named bpdeform apply parts.bpw $(yes cage.obj | head -20) --animate 24 -o moving.gltf
# A mesh in many places: each gets a mesh of its own. The list of the places, the copy of the document and a block of weights come one
# after the other.
limit=64M
named bpdeform bind nodes.gltf cage.obj -o nodes.bpw --outside near
named bpdeform apply nodes.bpw cage.obj -o moved.gltf
rm parts.gltf parts.bpw cage.obj moving.gltf nodes.bpw moved.gltf
awk -v n=300 'BEGIN {
  print "OFF\n" n * n, 2 * n * n, 0
  for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) {
    a = 6.283185307179586 * i / n; b = 6.283185307179586 * j / n; r = 3 + cos(b)
    printf "%.6f %.6f %.6f\n", r * cos(a), r * sin(a), sin(b)
  }
  for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) {
    p = i * n + j; q = (i + 1) % n * n + j; r = (i + 1) % n * n + (j + 1) % n; s = i * n + (j + 1) % n
    print 3, p, q, r; print 3, p, r, s
  }
}' > torus.off
named bpcheck torus.off
named bpcheck torus.off torus.off
# The proxy is read before its scenes, and its refusal has room for what describes them.
named bpcheck nodes.gltf torus.off
named bpcheck nodes.gltf nodes.gltf torus.off
# A mesh of many primitives, each with accessors and a material of its own.
python3 - << 'PYTHON'
import json, pathlib
n = 15000
data = "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
primitives = [{"attributes": {"POSITION": i}, "material": i % 1000} for i in range(n)]
accessors = [{"bufferView": i, "componentType": 5126, "count": 3, "type": "VEC3"} for i in range(n)]
views = [{"buffer": 0, "byteLength": 36} for i in range(n)]
scene = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": primitives}],
         "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, i / 1000, 0, 1]}} for i in range(1000)],
         "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": 36, "uri": data}]}
pathlib.Path("primitives.gltf").write_text(json.dumps(scene))
PYTHON
named bpvox primitives.gltf --resolution 100 -o o.bpv
named bpcheck primitives.gltf torus.off
# Several scenes: those after the one that does not fit count, too.
rm o.bpv
named bpvox torus.off primitives.gltf nodes.gltf --resolution 100 -o o.bpv
# A tileset of many contents, two of them large, and a tileset within it that is larger than it is itself.
write_octahedron small.obj
bplod small.obj --faces 8 --levels 1 --resolution 16 -q -o small > /dev/null
mv small/small.glb small.glb
python3 - << 'PYTHON'
import json, pathlib
box = {"box": [0, 0, 0, 400, 0, 0, 0, 400, 0, 0, 0, 400]}
def tileset(name, uris):
    tiles = [{"boundingVolume": box, "geometricError": 0, "content": {"uri": uri}} for uri in uris]
    root = {"boundingVolume": box, "geometricError": 9, "refine": "ADD", "children": tiles}
    pathlib.Path(name).write_text(json.dumps({"asset": {"version": "1.1"}, "geometricError": 9, "root": root}))
tileset("many.json", ["small.glb"] * 20000)
tileset("large.json", ["small.glb"] * 20 + ["primitives.gltf", "nodes.gltf"])
tileset("nested.json", ["small.glb"] * 4000 + ["many.json"])
PYTHON
named bpvox many.json --resolution 100 -o o.bpv
named bplod many.json --resolution 32 --faces 20 --levels 1 --up z -o lod
named bpcheck small.obj many.json
rm o.bpv
named bpvox large.json --resolution 100 -o o.bpv
named bpvox nested.json --resolution 100 -o o.bpv
rm -r primitives.gltf small small.obj small.glb many.json large.json nested.json lod
# Another program's importer works in a process of its own, within what this one leaves of --memory.
awk -v n=150000 'BEGIN {
  print "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\nOBJECT poly\nnumvert " 3 * n
  for (i = 0; i < 3 * n; ++i) print i % 100, int(i / 100) % 100, i % 7
  print "numsurf " n
  for (i = 0; i < n; ++i) print "SURF 0x0\nmat 0\nrefs 3\n" 3 * i " 0 0\n" 3 * i + 1 " 0 0\n" 3 * i + 2 " 0 0"
  print "kids 0"
}' > heap.ac
named bpvox heap.ac --resolution 100 -o o.bpv
# Materials of an OBJ: all files that it names count, 16 bytes for each material.
awk 'BEGIN { for (i = 0; i < 500000; ++i) printf "newmtl m%d\nKd 1 0 0\n", i }' > many.mtl
sed 's/ m/ n/' many.mtl > more.mtl
{ echo mtllib many.mtl; write_octahedron part.obj 4; cat part.obj; echo mtllib more.mtl; } > painted.obj
named bplod painted.obj --resolution 32 --faces 20 --levels 1 -o lod
[ "$least" -le 170 ] && echo "a million materials of one colour need at most 170 MiB" || echo "${least}M are named"
rm -r lod part.obj many.mtl more.mtl painted.obj
# The largest image counts.
python3 - << 'PYTHON'
import struct, zlib
def png(name, n):
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = (b"\0" + bytes([90, 120, 150]) * n) * n
    open(name, "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", n, n, 8, 2, 0, 0, 0)) +
                           chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b""))
png("a.png", 2500), png("b.png", 4000)
PYTHON
printf 'newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd b.png\n' > m.mtl
{ echo mtllib m.mtl; echo vt 0 0; echo vt 1 0; echo vt 0 1; write_octahedron part.obj 4; sed 's/^f \(.\) \(.\) \(.\)/f \1\/1 \2\/2 \3\/3/; 7s/^/usemtl a\n/; 11s/^/usemtl b\n/' part.obj; } > images.obj
limit=110M
named bplod images.obj --resolution 32 --faces 20 --levels 1 -o lod
rm -rf lod part.obj m.mtl a.png b.png images.obj
files
