# A good tileset, and what bpcheck says once it was changed. Each line of the table: the answer that is right, what was changed, and
# the change itself. Viewers cull, hide and move by what the changes touch; the answers are what they would draw.
cat > make.py <<'PY'
import copy, json, math, os, shutil, struct, subprocess, sys


def box(x, y, z):
    """Corners with z up, and twelve triangles that face outwards."""
    p = [((1 if i & 1 else -1) * x, (1 if i & 2 else -1) * y, (1 if i & 4 else -1) * z) for i in range(8)]
    f = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
    return p, f


def write_glb(path, doc, data):
    text = json.dumps(doc).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as out:
        out.write(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + 8 + len(data)) + struct.pack("<I4s", len(text), b"JSON") + text
                  + struct.pack("<I4s", len(data), b"BIN\0") + data)


def read_glb(path):
    data = open(path, "rb").read()
    n = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + n]), data[28 + n:]


def content(path, x, y, z):
    p, f = box(x, y, z)
    data = b"".join(struct.pack("<3f", a, c, -b) for a, b, c in p) + b"".join(struct.pack("<3H", *t) for t in f)
    write_glb(path, {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                     "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                     "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-x, -z, -y], "max": [x, z, y]},
                                   {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
                     "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
                     "buffers": [{"byteLength": len(data)}]}, data)


def volume(x, y, z):
    return {"box": [0, 0, 0, x, 0, 0, 0, y, 0, 0, 0, z]}


def write_scene(path, x, y, z):
    p, f = box(x, y, z)
    with open(path, "w") as out:
        out.writelines("v %g %g %g\n" % v for v in p)
        out.writelines("f %d %d %d\n" % tuple(i + 1 for i in t) for t in f)


write_scene("scene.obj", 1, 2, 3)
os.mkdir("good")
for name, by in ("r", 0.5), ("a", 0.25), ("b", 0.125):
    content("good/%s.glb" % name, 1 + by, 2 + by, 3 + by)
low = {"boundingVolume": volume(1.125, 2.125, 3.125), "geometricError": 0, "content": {"uri": "b.glb"}}
middle = {"boundingVolume": volume(1.25, 2.25, 3.25), "geometricError": 0.25, "content": {"uri": "a.glb"}, "children": [low]}
root = {"boundingVolume": volume(1.5, 2.5, 3.5), "geometricError": 0.5, "refine": "REPLACE", "content": {"uri": "r.glb"}, "children": [middle]}
good = {"asset": {"version": "1.1"}, "geometricError": 8, "root": root}


def edit(name, change):
    """Changes the JSON of a content."""
    doc, data = read_glb("bad/" + name)
    change(doc)
    write_glb("bad/" + name, doc, data)


def as_b3dm(name, features):
    """A content as older tilesets have it."""
    glb = open("bad/" + name, "rb").read()
    table = json.dumps(dict({"BATCH_LENGTH": 0}, **features)).encode()
    table += b" " * (-(28 + len(table)) % 8)
    with open("bad/" + name, "wb") as out:
        out.write(struct.pack("<4s6I", b"b3dm", 1, 28 + len(table) + len(glb), len(table), 0, 0, 0) + table + glb)


ANSWERS = {0: "proven", 1: "refuted", 5: "undecided", 3: "bad input"}
for line in open("table"):
    if line.startswith("#") or not line.strip():
        continue
    right, what, change = (part.strip() for part in line.split("|", 2))
    shutil.rmtree("bad", ignore_errors=True)
    shutil.copytree("good", "bad")
    t = copy.deepcopy(good)
    r = t["root"]
    m = r["children"][0]
    l = m["children"][0]
    exec(change)
    json.dump(t, open("bad/tileset.json", "w"))
    run = subprocess.run(["bpcheck", "scene.obj", "bad/tileset.json", "-q"], capture_output=True, text=True)
    answer = ANSWERS.get(run.returncode, "exit %d" % run.returncode)
    first = (run.stdout.split("\n")[0] if run.returncode != 3 else run.stderr.strip()) if answer != "proven" else ""
    print("%s%s: %s%s" % ("" if answer == right else "WRONG, is to be %s: " % right, what, answer, "; " + first if first else ""))
PY
cat > table <<'TABLE'
proven    | nothing                                    | pass
# What draws nothing.
refuted   | no content at all                          | [x.pop("content") for x in (r, m, l)]
refuted   | a child without content                    | r.update(children=[{"boundingVolume": volume(1, 1, 1), "geometricError": 0}])
proven    | the same where tiles are added             | r.update(refine="ADD", children=[{"boundingVolume": volume(1, 1, 1), "geometricError": 0}])
proven    | a child without content beside one with    | r["children"].append({"boundingVolume": volume(1, 1, 1), "geometricError": 0})
refuted   | a grandchild without content               | l.pop("content")
refuted   | an empty root with error 0                 | r.pop("content"), r.update(geometricError=0), m.update(geometricError=0)
refuted   | an empty root with a small error           | r.pop("content")
proven    | an empty root with the error of nothing    | r.pop("content"), r.update(geometricError=8)
refuted   | an empty tile between two with content     | m.pop("content")
refuted   | a tileset whose error is small             | t.update(geometricError=0.5)
undecided | one below the diagonal of the scene        | t.update(geometricError=7)
refuted   | contents of points                         | [edit(n, lambda d: d["meshes"][0]["primitives"][0].update(mode=0)) for n in ("r.glb", "a.glb", "b.glb")]
# What is culled.
refuted   | a box that is smaller by a bit             | r["boundingVolume"]["box"].__setitem__(3, 1.4999999999999998)
refuted   | a child's box that is larger by a bit      | m["boundingVolume"]["box"].__setitem__(3, 1.5000000000000002)
proven    | boxes that are turned                      | r.update(boundingVolume={"box": [0, 0, 0, 4, 4, 0, -4, 4, 0, 0, 0, 3.5]})
refuted   | a box that is turned and too small         | r.update(boundingVolume={"box": [0, 0, 0, 1.9, 1.9, 0, -1.9, 1.9, 0, 0, 0, 3.5]})
refuted   | a flat box                                 | r.update(boundingVolume=volume(1.5, 2.5, 0))
proven    | a sphere around all                        | r.update(boundingVolume={"sphere": [0, 0, 0, 5]})
refuted   | a sphere elsewhere                         | [x.update(boundingVolume={"sphere": [1e7, 0, 0, 1e-3]}) for x in (r, m, l)]
refuted   | a sphere that is too small                 | r.update(boundingVolume={"sphere": [0, 0, 0, 4.55]})
refuted   | a sphere in a smaller box                  | m.update(boundingVolume={"sphere": [0, 0, 0, 3.4]}), m.pop("children")
refuted   | a box and a sphere of which one is small   | r["boundingVolume"].update(sphere=[0, 0, 0, 1])
undecided | a region                                   | r.update(boundingVolume={"region": [0, 0, 0.1, 0.1, 0, 10]})
undecided | a box with an extension's volume           | r["boundingVolume"].update(extensions={"3DTILES_bounding_volume_cylinder": {}})
refuted   | a content's volume elsewhere               | r["content"].update(boundingVolume={"box": [1e7, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]})
proven    | a content's volume that holds it           | r["content"].update(boundingVolume=volume(1.5, 2.5, 3.5))
undecided | spheres of a tile that is sheared          | r.update(boundingVolume={"sphere": [0, 0, 0, 9]}, transform=[1, 0, 0, 0, 0.0625, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]), r.pop("children")
# What is hidden, or comes and goes.
undecided | viewerRequestVolume                        | r.update(viewerRequestVolume={"sphere": [1e7, 0, 0, 1]})
undecided | viewerRequestVolume of a child             | l.update(viewerRequestVolume={"sphere": [0, 0, 0, 100]})
undecided | a tile that expires                        | r.update(expire={"duration": 1})
undecided | a key that nobody knows                    | r.update(wobble=7)
undecided | an extension of a tile                     | r.update(extensions={"VENDOR_hides": {}})
undecided | an extension that is said to be used       | t.update(extensionsUsed=["VENDOR_hides"])
bad input | an extension that is required              | t.update(extensionsUsed=["VENDOR_hides"], extensionsRequired=["VENDOR_hides"])
proven    | an extension that changes nothing          | t.update(extensionsUsed=["3DTILES_content_gltf"], extensions={"3DTILES_content_gltf": {}})
proven    | extras anywhere                            | [x.update(extras={"wobble": 7}) for x in (t, t["asset"], r, r["content"], r["boundingVolume"])]
proven    | metadata                                   | r.update(metadata={"class": "a"}), t.update(schema={"classes": {"a": {"properties": {"name": {"type": "STRING"}}}}})
undecided | metadata that are a volume                 | r.update(metadata={"class": "a"}), t.update(schema={"classes": {"a": {"properties": {"v": {"semantic": "TILE_BOUNDING_BOX"}}}}})
undecided | metadata with a schema elsewhere           | r["content"].update(metadata={"class": "a"}), t.update(schemaUri="schema.json")
undecided | a node that may be hidden                  | edit("a.glb", lambda d: d["nodes"][0].update(extensions={"KHR_node_visibility": {"visible": False}}))
undecided | a node whose rotation is no turn           | edit("a.glb", lambda d: d["nodes"][0].update(rotation=[0, 0, 0, 2]))
undecided | a material of glass                        | edit("a.glb", lambda d: (d.update(materials=[{"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}}]), d["meshes"][0]["primitives"][0].update(material=0)))
undecided | a node with levels                         | edit("a.glb", lambda d: d["nodes"][0].update(extensions={"MSFT_lod": {"ids": []}}))
undecided | a primitive that is something else         | edit("a.glb", lambda d: d["meshes"][0]["primitives"][0].update(extensions={"VENDOR_splats": {}}))
undecided | an animation                               | edit("a.glb", lambda d: d.update(animations=[{"channels": [], "samplers": []}]))
undecided | a material that is seen through            | edit("a.glb", lambda d: d.update(materials=[{"alphaMode": "BLEND"}]))
undecided | a content without scenes                   | edit("a.glb", lambda d: (d.pop("scenes"), d.pop("scene")))
proven    | extensions of a content's looks            | edit("a.glb", lambda d: d.update(materials=[{"extensions": {"KHR_materials_unlit": {}}}], extensionsUsed=["KHR_materials_unlit"]))
# What is moved.
refuted   | a transform of the root                    | r.update(transform=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 9, 0, 0, 1])
refuted   | a turn of a child                          | m.update(transform=[0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
proven    | a mirrored root                            | r.update(transform=[-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
bad input | a transform to infinity                    | r.update(transform=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2])
undecided | a node whose matrix does so                | edit("a.glb", lambda d: d["nodes"][0].update(matrix=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2]))
refuted   | CESIUM_RTC                                 | edit("a.glb", lambda d: d.update(extensions={"CESIUM_RTC": {"center": [1000, 0, 0]}}, extensionsUsed=["CESIUM_RTC"]))
proven    | CESIUM_RTC that moves nothing              | edit("a.glb", lambda d: d.update(extensions={"CESIUM_RTC": {"center": [0, 0, 0]}}, extensionsUsed=["CESIUM_RTC"]))
undecided | CESIUM_RTC that a viewer need not know     | edit("b.glb", lambda d: d.update(extensions={"CESIUM_RTC": {"center": [0.0625, 0, 0]}})), l["boundingVolume"]["box"].__setitem__(0, 0.0625), l["boundingVolume"]["box"].__setitem__(3, 1.1875)
proven    | CESIUM_RTC that it must know               | edit("b.glb", lambda d: d.update(extensions={"CESIUM_RTC": {"center": [0.0625, 0, 0]}}, extensionsRequired=["CESIUM_RTC"])), l["boundingVolume"]["box"].__setitem__(3, 1.1875)
refuted   | gltfUpAxis Z                               | t["asset"].update(gltfUpAxis="Z")
refuted   | gltfUpAxis X                               | t["asset"].update(gltfUpAxis="X")
proven    | gltfUpAxis Y                               | t["asset"].update(gltfUpAxis="Y")
undecided | gltfUpAxis y, which viewers take in two ways | t["asset"].update(gltfUpAxis="y")
bad input | gltfUpAxis -X                              | t["asset"].update(gltfUpAxis="-X")
proven    | a b3dm                                     | as_b3dm("a.glb", {})
refuted   | a b3dm with RTC_CENTER                     | as_b3dm("a.glb", {"RTC_CENTER": [9, 0, 0]})
proven    | a b3dm that its tile moves back            | as_b3dm("a.glb", {"RTC_CENTER": [9, 0, 0]}), m.update(transform=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -9, 0, 0, 1]), m["boundingVolume"]["box"].__setitem__(0, 9), m.pop("children")
undecided | a b3dm with a table of more                | as_b3dm("a.glb", {"INSTANCES_LENGTH": 7})
refuted   | a content with extras.up, and turned by it | edit("a.glb", lambda d: (d["asset"].update(extras={"up": "z"}), d["nodes"].append({"matrix": [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1], "children": [0]}), d["scenes"][0].update(nodes=[1])))
proven    | a content with extras.up alone             | edit("a.glb", lambda d: d["asset"].update(extras={"up": "z"}))
# What is replaced.
refuted   | a content that is smaller than the scene   | content("bad/b.glb", 1, 1.5, 3)
refuted   | a content that is missing                  | os.remove("bad/a.glb")
refuted   | half a content                             | os.truncate("bad/a.glb", 200)
undecided | a content of another kind                  | open("bad/a.glb", "wb").write(b"pnts" + bytes(24))
refuted   | a content that is a folder                 | os.remove("bad/a.glb"), os.mkdir("bad/a.glb")
refuted   | a content that is a pipe                   | os.remove("bad/a.glb"), os.mkfifo("bad/a.glb")
bad input | a content on the network                   | m["content"].update(uri="https://example.org/a.glb")
bad input | a content with a backslash                 | os.mkdir("bad/s"), shutil.move("bad/a.glb", "bad/s\\a.glb"), content("bad/s/a.glb", 0.1, 0.1, 0.1), m["content"].update(uri="s\\a.glb")
bad input | a content with a blank before it           | shutil.move("bad/a.glb", "bad/ a.glb"), content("bad/a.glb", 0.1, 0.1, 0.1), m["content"].update(uri=" a.glb")
bad input | a content at the root of the server        | m["content"].update(uri=os.path.abspath("bad/a.glb"))
bad input | a content with a scheme                    | shutil.move("bad/a.glb", "bad/http:a.glb"), m["content"].update(uri="http:a.glb")
bad input | a slash that is encoded                    | os.mkdir("bad/s"), shutil.move("bad/a.glb", "bad/s/a.glb"), m["content"].update(uri="s%2Fa.glb")
refuted   | a query that a file has in its name        | shutil.move("bad/a.glb", "bad/a.glb?v=7"), content("bad/a.glb", 0.1, 0.1, 0.1), m["content"].update(uri="a.glb?v=7")
refuted   | a fragment that a file has in its name     | shutil.move("bad/a.glb", "bad/a.glb#x"), content("bad/a.glb", 0.1, 0.1, 0.1), m["content"].update(uri="a.glb#x")
bad input | a uri and a url                            | shutil.move("bad/a.glb", "bad/g.glb"), content("bad/a.glb", 0.1, 0.1, 0.1), m.update(content={"uri": "g.glb", "url": "a.glb"})
undecided | contents whose bounds lie elsewhere        | [edit(n, lambda d: d["accessors"][0].update(min=[100, 100, 100], max=[101, 101, 101])) for n in ("r.glb", "a.glb", "b.glb")]
undecided | contents without bounds                    | [edit(n, lambda d: (d["accessors"][0].pop("min"), d["accessors"][0].pop("max"))) for n in ("r.glb", "a.glb", "b.glb")]
proven    | a content with a query                     | m["content"].update(uri="a.glb?v=7")
bad input | a tileset as a content                     | m["content"].update(uri="more.json?v=7")
bad input | several contents                           | r.pop("content"), r.update(contents=[{"uri": "r.glb"}, {"uri": "a.glb"}])
bad input | implicit tiles                             | r.update(implicitTiling={"subdivisionScheme": "OCTREE"})
refuted   | an error above the parent's                | l.update(geometricError=0.3)
proven    | an error in a tile that is smaller         | m.update(transform=[0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1], geometricError=0.75), m.update(boundingVolume=volume(2.5, 4.5, 6.5)), m.pop("children"), content("bad/a.glb", 2.5, 4.5, 6.5)
refuted   | a root that does not say how it is refined | r.pop("refine")
refuted   | a way to refine that is none               | m.update(refine="replace")
proven    | version 1.0                                | t["asset"].update(version="1.0"), r["content"].update(url=r["content"].pop("uri"))
undecided | version 2.0                                | t["asset"].update(version="2.0")
TABLE
python3 make.py

# The scene, too, must be there.
cp -r good whole && python3 -c 'exec(open("make.py").read().split("ANSWERS")[0].replace("os.mkdir(\"good\")", "")); json.dump(good, open("whole/tileset.json", "w"))'
bpcheck scene.obj whole/tileset.json
: > empty.obj
try bpcheck empty.obj whole/tileset.json

# Four tiles in a row below a level in one mesh: no tile stands between that draws nothing.
write_painted_cubes
bplod part*.obj --name cubes --voxel 0.1 --tile 64 --profile 3dtiles --appearance off -o tiles -q > list
bpcheck part*.obj tiles
python3 - <<'PY'
import json
def below(tile, drawn):
    here = "content" in tile
    return (drawn and not here) + sum(below(c, drawn or here) for c in tile.get("children", []))
root = json.load(open("tiles/tileset.json"))["root"]
print(max(len(t.get("children", [])) for t in [root] + root["children"]), "children at most,", below(root, False), "below a content draw nothing")
PY
