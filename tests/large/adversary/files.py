"""Plain writers and readers of small meshes, for the adversary: they return what a file says, exactly.

A mesh is a list of triangles of three points. Every writer returns the mesh that its file holds, as Fractions: rounded to
float32 where the format has no more, and moved by the nodes that it wrote.
"""
import json
import os
import shutil
import struct
import subprocess
from fractions import Fraction

from oracle import exact


def float32(x):
    return struct.unpack("<f", struct.pack("<f", float(x)))[0]


def rounded(mesh):
    return [tuple(tuple(float32(x) for x in p) for p in t) for t in mesh]


def indexed(mesh):
    """Positions, each once, and triples of their numbers."""
    number = {}
    faces = [tuple(number.setdefault(tuple(p), len(number)) for p in t) for t in mesh]
    return list(number), faces


def said(mesh):
    return [exact(t) for t in mesh]


def write_obj(mesh, path, rng):
    points, faces = indexed(mesh)
    with open(path, "w") as f:
        f.writelines("v " + " ".join(repr(float(x)) for x in p) + "\n" for p in points)
        f.writelines("f " + " ".join(str(i + 1) for i in t) + "\n" for t in faces)
    return said(mesh)


def write_off(mesh, path, rng):
    points, faces = indexed(mesh)
    with open(path, "w") as f:
        f.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        f.writelines(" ".join(repr(float(x)) for x in p) + "\n" for p in points)
        f.writelines("3 " + " ".join(map(str, t)) + "\n" for t in faces)
    return said(mesh)


def write_ply(mesh, path, rng):
    points, faces = indexed(mesh)
    kind = rng.choice(["double", "float"])
    if kind == "float":
        mesh = rounded(mesh)
        points, faces = indexed(mesh)
    form = rng.choice(["binary_little_endian", "binary_big_endian", "ascii"])
    order = ">" if "big" in form else "<"
    with open(path, "wb") as f:
        f.write(f"ply\nformat {form} 1.0\nelement vertex {len(points)}\n".encode())
        f.write("".join(f"property {kind} {c}\n" for c in "xyz").encode())
        f.write(f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        for p in points:
            f.write(" ".join(repr(float(x)) for x in p).encode() + b"\n" if form == "ascii" else struct.pack(order + "3" + kind[0], *p))
        for t in faces:
            f.write(b"3 %d %d %d\n" % t if form == "ascii" else struct.pack(order + "B3i", 3, *t))
    return said(mesh)


def write_stl(mesh, path, rng):
    mesh = rounded(mesh)
    with open(path, "wb") as f:
        f.write(b" " * 80 + struct.pack("<I", len(mesh)))
        for t in mesh:
            f.write(struct.pack("<12fH", 0, 0, 0, *(x for p in t for x in p), 0))
    return said(mesh)


def random_node(rng):
    """JSON of a node's transform, and its exact matrix: 12 Fractions by rows."""
    F = Fraction
    kind = rng.randrange(4)
    if kind == 0:
        return {}, [F(int(i == j)) for i in range(3) for j in range(4)]
    if kind == 1:
        s, t = [rng.choice([0.5, 2.0, 0.1, 1.0, 3.0])] * 3, [rng.choice([0.0, 0.1, 1 / 3, 100.0, 654321.1]) for _ in range(3)]
        return {"scale": s, "translation": t}, [F(s[i]) if i == j else F(t[i]) if j == 3 else F(0) for i in range(3) for j in range(4)]
    axes = rng.choice([(0, 1, 2), (1, 2, 0), (2, 0, 1)])  # even: not mirrored
    m = [[0.0] * 4 for _ in range(4)]
    for i in range(3):
        m[i][axes[i]] = 1.0 if kind == 2 else rng.choice([1.0, 0.7, 1.25])
        m[i][3] = rng.choice([0.0, 0.1, -7.25])
    m[3][3] = 1.0
    return {"matrix": [m[i][j] for j in range(4) for i in range(4)]}, [F(m[i][j]) for i in range(3) for j in range(4)]


def moved(matrix, p):
    return tuple(sum(matrix[4 * i + j] * p[j] for j in range(3)) + matrix[4 * i + 3] for i in range(3))


def before(matrix, p):
    """The point that `matrix`, a scaled permutation of the axes, moves to p; in doubles, so that it lands beside p."""
    p, q = [p[i] - float(matrix[4 * i + 3]) for i in range(3)], [0.0] * 3
    for i in range(3):
        for j in range(3):
            if matrix[4 * i + j] != 0:
                q[j] = p[i] / float(matrix[4 * i + j])
    return tuple(q)


def write_glb(mesh, path, rng):
    """Positions in float32 behind one or two nodes that move them back to the mesh, or right beside it."""
    chain = [random_node(rng) for _ in range(rng.choice([1, 1, 2]))]
    for _, matrix in reversed(chain):
        mesh = [tuple(before(matrix, p) for p in t) for t in mesh]
    mesh = rounded(mesh)
    points, faces = indexed(mesh)
    positions = b"".join(struct.pack("<3f", *p) for p in points)
    indices = b"".join(struct.pack("<3I", *t) for t in faces)
    nodes = [{**node, **({"mesh": 0} if i == 0 else {"children": [i - 1]})} for i, (node, _) in enumerate(chain)]
    finite = [p for p in points if all(abs(x) < 1e38 for x in p)] or [(0, 0, 0)]
    doc = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [len(nodes) - 1]}], "nodes": nodes,
           "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
           "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
                          "min": [min(p[i] for p in finite) for i in range(3)], "max": [max(p[i] for p in finite) for i in range(3)]},
                         {"bufferView": 1, "componentType": 5125, "count": 3 * len(faces), "type": "SCALAR"}],
           "bufferViews": [{"buffer": 0, "byteLength": len(positions)}, {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)}],
           "buffers": [{"byteLength": len(positions) + len(indices)}]}
    text = json.dumps(doc).encode()
    text += b" " * (-len(text) % 4)
    blob = positions + indices
    with open(path, "wb") as f:
        f.write(struct.pack("<III", 0x46546C67, 2, 12 + 8 + len(text) + 8 + len(blob)))
        f.write(struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(blob), 0x004E4942) + blob)
    result = said(mesh)
    for _, matrix in chain:
        result = [tuple(moved(matrix, p) for p in t) for t in result]
    return result


def write_dae(mesh, path, rng):
    points, faces = indexed(mesh)
    numbers = " ".join(repr(float(x)) for p in points for x in p)
    with open(path, "w") as f:
        f.write('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
                '<asset><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>'
                f'<source id="p"><float_array id="a" count="{3 * len(points)}">{numbers}</float_array><technique_common>'
                f'<accessor source="#a" count="{len(points)}" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>'
                '<param name="Z" type="float"/></accessor></technique_common></source>'
                '<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>'
                f'<triangles count="{len(faces)}"><input semantic="VERTEX" source="#v" offset="0"/><p>{" ".join(str(i) for t in faces for i in t)}</p>'
                '</triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node id="n">'
                '<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>')
    return said(mesh)


def write_ac(mesh, path, rng):
    points, faces = indexed(mesh)
    with open(path, "w") as f:
        f.write('AC3Db\nMATERIAL "m" rgb 1 1 1  amb 0 0 0  emis 0 0 0  spec 0 0 0  shi 0  trans 0\nOBJECT world\nkids 1\nOBJECT poly\n')
        f.write(f"numvert {len(points)}\n" + "".join(" ".join(repr(float(x)) for x in p) + "\n" for p in points))
        f.write(f"numsurf {len(faces)}\n" + "".join("SURF 0x00\nmat 0\nrefs 3\n" + "".join(f"{i} 0 0\n" for i in t) for t in faces))
        f.write("kids 0\n")
    return said(mesh)


def write_x(mesh, path, rng):
    """DirectX text: left-handed, so z changes its sign and the faces their order."""
    points, faces = indexed(mesh)
    with open(path, "w") as f:
        f.write("xof 0303txt 0032\nMesh m {\n" + f"{len(points)};\n")
        f.write(",\n".join(";".join(repr(float(x)) for x in (p[0], p[1], -p[2])) + ";" for p in points) + ";\n")
        f.write(f"{len(faces)};\n" + ",\n".join(f"3;{t[0]},{t[2]},{t[1]};" for t in faces) + ";\n}\n")
    return said(mesh)


def write_draco(mesh, path, rng):
    """A GLB whose triangles are packed by Google's encoder; what it holds is told by Google's decoder."""
    stem = path[:-4]
    write_obj(rounded(mesh), stem + ".obj", rng)
    subprocess.run(["draco_encoder", "-i", stem + ".obj", "-o", stem + ".drc", "-qp", "0" if rng.random() < 0.5 else "16"], check=True, capture_output=True)
    subprocess.run(["draco_decoder", "-i", stem + ".drc", "-o", stem + ".ply"], check=True, capture_output=True)
    result = read_ply(stem + ".ply")
    with open(stem + ".drc", "rb") as f:
        blob = f.read()
    for ending in (".obj", ".drc", ".ply"):
        os.remove(stem + ending)
    count = len({p for t in result for p in t})
    doc = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
           "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"],
           "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "extensions":
                                       {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
           "accessors": [{"componentType": 5126, "count": count, "type": "VEC3", "min": [float(min(p[i] for t in result for p in t)) for i in range(3)],
                          "max": [float(max(p[i] for t in result for p in t)) for i in range(3)]}, {"componentType": 5125, "count": 3 * len(result), "type": "SCALAR"}],
           "bufferViews": [{"buffer": 0, "byteLength": len(blob)}], "buffers": [{"byteLength": len(blob)}]}
    text = json.dumps(doc).encode()
    text += b" " * (-len(text) % 4)
    blob += b"\0" * (-len(blob) % 4)
    with open(path, "wb") as f:
        f.write(struct.pack("<III", 0x46546C67, 2, 12 + 8 + len(text) + 8 + len(blob)))
        f.write(struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(blob), 0x004E4942) + blob)
    return said(result)


WRITERS = {"obj": write_obj, "off": write_off, "ply": write_ply, "stl": write_stl, "glb": write_glb, "dae": write_dae, "ac": write_ac, "x": write_x}
if shutil.which("draco_encoder"):
    WRITERS["draco"] = write_draco


def edit_glb(path, change):
    """Changes the text of the JSON in a GLB."""
    with open(path, "rb") as f:
        data = f.read()
    (n,) = struct.unpack_from("<I", data, 12)
    text = change(data[20:20 + n].decode().rstrip()).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + n:]
    with open(path, "wb") as f:
        f.write(struct.pack("<III", 0x46546C67, 2, 20 + len(text) + len(rest)) + struct.pack("<II", len(text), 0x4E4F534A) + text + rest)


def in_json(change):
    def edited(text):
        doc = json.loads(text)
        change(doc)
        return json.dumps(doc)
    return lambda path, rng: edit_glb(path, edited)


def in_lines(change):
    def edit(path, rng):
        with open(path, "rb") as f:
            lines = f.read().split(b"\n")
        with open(path, "wb") as f:
            f.write(b"\n".join(change(lines, rng)))
    return edit


def goes_on(lines, rng):
    at = rng.randrange(len(lines) - 1)
    return lines[:at] + [rng.choice([b"# from C:\\", b"s off \\", b"o part\\", b"vn 0 0 1 \\"])] + lines[at:]


def header_twice(lines, rng):
    at = rng.choice([i for i, line in enumerate(lines) if line.startswith((b"element ", b"property ")) and i < lines.index(b"end_header")])
    return lines[:at] + [lines[at]] + lines[at:]


def more_data(lines, rng):
    return lines[:-1] + [lines[-1] + b"3 0 1 2\n" * rng.choice([1, 3])]


# What makes other programs read a proxy in another way, hide it, or cull it: bpcheck must not prove it then.
DECORATIONS = {
    "glb": [lambda path, rng: edit_glb(path, lambda t: t.replace('"mesh": 0', '"mesh": 0, "mesh": 0', 1)),
            lambda path, rng: edit_glb(path, lambda t: t.replace('"asset"', '"nodes": [], "asset"', 1)),
            in_json(lambda d: d["accessors"][0].update(min=[x + 1e9 for x in d["accessors"][0]["min"]], max=[x + 2e9 for x in d["accessors"][0]["max"]])),
            in_json(lambda d: d["accessors"][0].pop("min")),
            in_json(lambda d: (d.pop("scene"), d.pop("scenes"))),
            in_json(lambda d: next(n for n in d["nodes"] if "mesh" in n).update(extensions={"KHR_node_visibility": {"visible": False}})),
            in_json(lambda d: d.update(extensions={"CESIUM_RTC": {"center": [1, 0, 0]}})),
            in_json(lambda d: d["buffers"][0].update(uri="p.bin?x"))],
    "ply": [in_lines(header_twice), in_lines(more_data)],
    "obj": [in_lines(goes_on)],
}


def write(mesh, kind, stem, rng):
    """Returns the file's name and what it holds."""
    path = f"{stem}.{'glb' if kind == 'draco' else kind}"
    return path, WRITERS[kind](mesh, path, rng)


def read_ply(path):
    """Little-endian PLY as bpmesh and draco_decoder write it: float or double x, y, z first, lists of uchar and int."""
    with open(path, "rb") as f:
        data = f.read()
    end = data.index(b"end_header\n") + 11
    sizes = {"char": "b", "uchar": "B", "uint8": "B", "short": "h", "ushort": "H", "int": "i", "int32": "i", "uint": "I", "uint32": "I", "float": "f", "float32": "f", "double": "d", "float64": "d"}
    elements = []
    for line in data[:end].decode().splitlines():
        word = line.split()
        if word[:1] == ["element"]:
            elements.append([word[1], int(word[2]), []])
        elif word[:1] == ["property"]:
            elements[-1][2].append(word[1:])
    at, points, mesh = end, [], []
    for name, count, properties in elements:
        for _ in range(count):
            values = []
            for p in properties:
                if p[0] == "list":
                    (n,) = struct.unpack_from("<" + sizes[p[1]], data, at)
                    at += struct.calcsize(sizes[p[1]])
                    values.append(struct.unpack_from(f"<{n}{sizes[p[2]]}", data, at))
                    at += n * struct.calcsize(sizes[p[2]])
                else:
                    values.append(struct.unpack_from("<" + sizes[p[0]], data, at)[0])
                    at += struct.calcsize(sizes[p[0]])
            if name == "vertex":
                points.append(tuple(values[:3]))
            elif name == "face":
                face = next(v for v in values if isinstance(v, tuple))
                mesh += [(points[face[0]], points[face[i]], points[face[i + 1]]) for i in range(1, len(face) - 1)]
    return mesh


def read_obj(path):
    points, mesh = [], []
    for line in open(path):
        word = line.split()
        if word[:1] == ["v"]:
            points.append(tuple(map(float, word[1:4])))
        elif word[:1] == ["f"]:
            face = [points[int(w.split("/")[0]) - 1] for w in word[1:]]
            mesh += [(face[0], face[i], face[i + 1]) for i in range(1, len(face) - 1)]
    return mesh


def node_matrix(node):
    F = Fraction
    if "matrix" in node:
        m = node["matrix"]
        return [F(m[4 * j + i]) for i in range(3) for j in range(4)]
    if node.get("rotation", [0, 0, 0, 1]) != [0, 0, 0, 1]:
        raise ValueError("this reader knows no rotations")
    s, t = node.get("scale", [1, 1, 1]), node.get("translation", [0, 0, 0])
    return [F(s[i]) if i == j else F(t[i]) if j == 3 else F(0) for i in range(3) for j in range(4)]


def read_glb(path):
    """All meshes of the scene's nodes, moved by them, as Fractions; float32 positions without compression."""
    with open(path, "rb") as f:
        data = f.read()
    (n,) = struct.unpack_from("<I", data, 12)
    doc, start = json.loads(data[20:20 + n]), 28 + n

    def accessor(i, codes, width):
        a = doc["accessors"][i]
        view = doc["bufferViews"][a["bufferView"]]
        at, code = start + view.get("byteOffset", 0) + a.get("byteOffset", 0), codes[a["componentType"]]
        step = view.get("byteStride", width * struct.calcsize(code))
        return [struct.unpack_from(f"<{width}{code}", data, at + k * step) for k in range(a["count"])]

    def visit(i):
        node, mesh = doc["nodes"][i], []
        for primitive in doc["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
            points = accessor(primitive["attributes"]["POSITION"], {5126: "f"}, 3)
            order = [k for (k,) in accessor(primitive["indices"], {5121: "B", 5123: "H", 5125: "I"}, 1)]
            mesh += [exact(points[k] for k in order[j:j + 3]) for j in range(0, len(order), 3)]
        for child in node.get("children", []):
            mesh += visit(child)
        matrix = node_matrix(node)
        return [tuple(moved(matrix, p) for p in t) for t in mesh]

    return [t for i in doc["scenes"][doc.get("scene", 0)]["nodes"] for t in visit(i)]


READERS = {"obj": read_obj, "ply": read_ply, "glb": read_glb}
