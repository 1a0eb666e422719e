# A triangle left behind by mistake makes all voxels huge: it is told, with its place, and the voxels that suit the rest.
write_cube house.obj 8
cp "$BP_ROOT/tests/data/bugs/stray.obj" .
try bpvox stray.obj --resolution 64 -o far.bpv
try bplod stray.obj --profile collision -o out
sed -E 's/^v 10000(.) 10000(.) 10000(.)/v 6\1 6\2 6\3/' stray.obj > near.obj
try bpvox near.obj --resolution 64 -o near.bpv
# The triangle first: its place is where the scene is measured from.
(tail -1 stray.obj > face; grep ^v stray.obj; cat face; grep ^f stray.obj | sed '$d') > first.obj
try bpvox first.obj --resolution 64 -o first.bpv
# The note names the part where the file has names: of several, the first and how many.
(echo o house; sed '$d' stray.obj; echo o bird; tail -1 stray.obj) > named.obj
try bpvox named.obj --resolution 64 -o named.bpv
(cat named.obj; echo o cloud; tail -1 stray.obj) > two.obj
try bplod two.obj --faces 8 --levels 1 --resolution 64 -o two
python3 - << 'PYTHON'
import base64, json, pathlib, struct
lines = [line.split() for line in open("stray.obj")]
points = [[float(x) for x in line[1:4]] for line in lines if line[0] == "v"]
faces = [[points[int(word.split("/")[0]) - 1] for word in line[1:]] for line in lines if line[0] == "f"]
cut = [[f[0], f[i - 1], f[i]] for f in faces for i in range(2, len(f))]
parts = [cut[:-1], cut[-1:]]
data, views, accessors = b"", [], []
for part in parts:
    bytes = b"".join(struct.pack("<3f", *p) for t in part for p in t)
    views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(bytes)})
    accessors.append({"bufferView": len(accessors), "componentType": 5126, "count": 3 * len(part), "type": "VEC3"})
    data += bytes
uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
pathlib.Path("named.gltf").write_text(json.dumps({
    "asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}], "nodes": [{"name": "house", "mesh": 0}, {"name": "bird", "mesh": 1}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": i}}]} for i in range(2)], "accessors": accessors, "bufferViews": views,
    "buffers": [{"byteLength": len(data), "uri": uri}]}))
PYTHON
try bpvox named.gltf --resolution 64 -o gltf.bpv
try bpvox house.obj --resolution 64 -o house.bpv
# A flood that comes in by an open side is told. One side of the house is missing.
sed '$d' house.obj > open.obj
try bpvox open.obj --resolution 64 -o open.bpv
try bpvox open.obj --resolution 64 --fill winding -o winding.bpv
# A scale that is a fifth of the scene is said with what the same number of percent would be.
try bpclose house.bpv --scale 2 -o closed.bpv
# A wall stands upright, and a map lies flat.
printf 'v -5 0 -0.1\nv 5 0 -0.1\nv 5 4 -0.1\nv -5 4 0.1\nf 1 2 3 4\n' > wall.obj
bpvox wall.obj --resolution 32 > wall.bpv
try bpmesh wall.bpv --faces 20 -o wall2.glb
sed 's/-0.1/0/; s/0.1/0.3/' wall.obj > map.obj
bpvox map.obj --resolution 32 > map.bpv
try bpmesh map.bpv --faces 20 -o map.glb
