"""Reads the meshes that the tools write: GLB, and OBJ of cages, which has quads. Blender's own importers turn some formats and not others,
round a far location, and fail in Debian 12. Nothing here touches Blender's data."""
from __future__ import annotations

import json
import struct
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


@dataclass
class Mesh:
    """A mesh in Blender's axes. A vertex of the file and its twins at the same place are one vertex; what differs between them, as places in
    images, belongs to the corners of the faces."""

    name: str
    vertices: np.ndarray  # (n, 3), float64
    corners: np.ndarray  # the vertex of each corner, face by face
    sizes: np.ndarray  # the number of corners of each face
    normals: np.ndarray | None = None  # of corners
    places: np.ndarray | None = None  # of corners
    colors: np.ndarray | None = None  # of corners, linear
    material: dict | None = None  # as glTF has it


@dataclass
class Made:
    """What a file of the tools holds."""

    meshes: list[Mesh]
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)  # to be added to all vertices
    comments: list[str] = field(default_factory=list)  # "contract: ..." and "provenance: ...", as PLY and OBJ have them
    images: list[tuple[str, bytes]] = field(default_factory=list)  # type and contents


def z_up(values: np.ndarray) -> np.ndarray:
    """Turns vectors of glTF, which has y up, to z up. Nothing is rounded."""
    return np.stack([values[:, 0], -values[:, 2], values[:, 1]], axis=1)


def read_glb(path: Path) -> Made:
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    text = json.loads(data[20:20 + length])
    binary = memoryview(data)[28 + length:]

    def view(i: int) -> memoryview:
        place = text["bufferViews"][i]
        begin = place.get("byteOffset", 0)
        return binary[begin:begin + place["byteLength"]]

    def array(i: int) -> np.ndarray:
        accessor = text["accessors"][i]
        width, kind = WIDTHS[accessor["type"]], TYPES[accessor["componentType"]]
        values = np.frombuffer(view(accessor["bufferView"]), kind, accessor["count"] * width, accessor.get("byteOffset", 0))
        return values.reshape(-1, width) if width > 1 else values

    extras = text["asset"].get("extras", {})
    made = Made([], tuple(map(float, extras.get("origin", [0, 0, 0]))), comments_of(extras))
    for node in text["nodes"]:
        for primitive in text["meshes"][node["mesh"]]["primitives"]:
            made.meshes.append(_mesh(node["name"], primitive, array, text))
    made.images = [(image["mimeType"], bytes(view(image["bufferView"]))) for image in text.get("images", [])]
    return made


def _mesh(name: str, primitive: dict, array, text: dict) -> Mesh:
    attributes = {key: array(i) for key, i in primitive["attributes"].items()}
    indices = array(primitive["indices"]).astype(np.int64)
    places, first = _unique(attributes["POSITION"])
    mesh = Mesh(name, z_up(places.astype(float)), first[indices], np.full(len(indices) // 3, 3))
    if "NORMAL" in attributes:
        mesh.normals = z_up(attributes["NORMAL"])[indices]
    if "TEXCOORD_0" in attributes:
        mesh.places = (attributes["TEXCOORD_0"] * np.float32([1, -1]) + np.float32([0, 1]))[indices]
    if "COLOR_0" in attributes:
        colors = attributes["COLOR_0"]
        mesh.colors = (colors / np.float32(255) if colors.dtype == np.uint8 else colors)[indices]
    if "material" in primitive:
        mesh.material = dict(text["materials"][primitive["material"]])
        mesh.material["images"] = [texture["source"] for texture in text.get("textures", [])]
    return mesh


def _unique(positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns each position once, in the order of the file, and for each vertex the number of its position."""
    _, first, inverse = np.unique(positions, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return positions[first[order]], rank[inverse.reshape(-1)]


def read_obj(path: Path) -> Made:
    """Reads vertices and faces, and what the comments tell. The axes are those of the scene."""
    vertices, faces, comments, origin = [], [], [], [0.0, 0.0, 0.0]
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
        elif line.startswith("# origin: "):
            origin = [float(word) for word in words[2:5]]
        elif line.startswith(("# contract: ", "# provenance: ")):
            comments.append(line[2:])
    sizes = np.array([len(face) for face in faces])
    corners = np.array([corner for face in faces for corner in face])
    mesh = Mesh(path.stem, np.array(vertices), corners, sizes)
    return Made([mesh], tuple(origin), comments)


def comments_of(extras: dict) -> list[str]:
    """Returns what the extras of a GLB tell, as PLY and OBJ tell it in comments."""
    lines = ["provenance: {tool} {version} {options}".format(**record) + (f" input {record['input']}" if "input" in record else "")
             for record in extras.get("provenance", [])]
    return lines + ([f"contract: {extras['contract']}"] if "contract" in extras else [])
