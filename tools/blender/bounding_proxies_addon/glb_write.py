"""Writes scenes as GLB: local coordinates as Blender has them, in 32-bit floats, and the matrix of each object beside them. So the file is
exact, however the objects are placed: a reader multiplies in double precision, and nothing was rounded before. Nothing here touches Blender's
data."""
from __future__ import annotations

import json
import struct
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

FLOAT, UINT = 5126, 5125
# Blender's z points up, glTF's y does. The entries are 0, 1 and -1, so nothing is rounded. By columns, as glTF has them.
Y_UP = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1]


@dataclass
class Part:
    """Triangles of one material. If there are places in images or colours, every corner of a triangle has a vertex of its own."""

    positions: np.ndarray  # (n, 3), float32
    indices: np.ndarray  # (3 m), uint32
    material: int = -1  # of Scene.materials
    places: np.ndarray | None = None  # (n, 2), float32, as Blender has them: v points up
    colors: np.ndarray | None = None  # (n, 4), float32, linear


@dataclass
class Scene:
    """Meshes, where they stand, their materials and images."""

    meshes: list[list[Part]] = field(default_factory=list)
    instances: list[tuple[int, str, list[float]]] = field(default_factory=list)  # a mesh, a name, a matrix by columns
    materials: list[dict] = field(default_factory=list)  # as glTF has them
    images: list[tuple[str, bytes]] = field(default_factory=list)  # type and contents of image files; texture i is image i
    extras: dict = field(default_factory=dict)  # of the asset

    @property
    def triangles(self) -> int:
        return sum(len(part.indices) // 3 for mesh, _, _ in self.instances for part in self.meshes[mesh])


class _File:
    """Collects the buffer of a GLB and what describes it."""

    def __init__(self) -> None:
        self.chunks: list[bytes] = []
        self.size = 0
        self.views: list[dict] = []
        self.accessors: list[dict] = []

    def view(self, data: bytes) -> int:
        self.views.append({"buffer": 0, "byteOffset": self.size, "byteLength": len(data)})
        padded = data + b"\0" * (-len(data) % 4)
        self.chunks.append(padded)
        self.size += len(padded)
        return len(self.views) - 1

    def array(self, values: np.ndarray, kind: str, component: int, bounds: bool = False) -> int:
        values = np.ascontiguousarray(values, np.float32 if component == FLOAT else np.uint32)
        accessor = {"bufferView": self.view(values.tobytes()), "componentType": component, "count": len(values), "type": kind}
        if bounds:
            # Coordinates that are no numbers are for the tool to report. JSON knows no NaN.
            finite = values[np.isfinite(values).all(axis=1)]
            if len(finite):
                accessor["min"], accessor["max"] = finite.min(axis=0).tolist(), finite.max(axis=0).tolist()
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def primitive(self, part: Part) -> dict:
        attributes = {"POSITION": self.array(part.positions, "VEC3", FLOAT, bounds=True)}
        if part.places is not None:
            attributes["TEXCOORD_0"] = self.array(part.places * np.float32([1, -1]) + np.float32([0, 1]), "VEC2", FLOAT)
        if part.colors is not None:
            attributes["COLOR_0"] = self.array(part.colors, "VEC4", FLOAT)
        made = {"attributes": attributes, "indices": self.array(part.indices, "SCALAR", UINT)}
        return made if part.material < 0 else {**made, "material": part.material}


def write_glb(path: Path, scene: Scene) -> None:
    """Writes the scene. Parts without triangles are left out, since glTF has no empty arrays."""
    file = _File()
    meshes, number = [], {}
    for i, parts in enumerate(scene.meshes):
        primitives = [file.primitive(part) for part in parts if len(part.indices)]
        if primitives:
            number[i] = len(meshes)
            meshes.append({"primitives": primitives})
    nodes = [{"name": name, "mesh": number[mesh], "matrix": matrix} for mesh, name, matrix in scene.instances if mesh in number]
    nodes.append({"name": "z up", "matrix": Y_UP, "children": list(range(len(nodes)))})
    text = {"asset": {"version": "2.0", "generator": "Bounding Proxies for Blender", "extras": scene.extras}, "scene": 0,
            "scenes": [{"nodes": [len(nodes) - 1]}], "nodes": nodes, "meshes": meshes}
    if scene.materials:
        text["materials"] = scene.materials
    if any("extensions" in json.dumps(m) for m in scene.materials):
        text["extensionsUsed"] = ["KHR_texture_transform"]
    if scene.images:
        text["images"] = [{"mimeType": kind, "bufferView": file.view(data)} for kind, data in scene.images]
        text["textures"] = [{"source": i} for i in range(len(scene.images))]
    text.update(accessors=file.accessors, bufferViews=file.views, buffers=[{"byteLength": file.size}])
    _write(path, {key: value for key, value in text.items() if value != []}, file)


def _write(path: Path, text: dict, file: _File) -> None:
    head = json.dumps(text, separators=(",", ":")).encode()
    head += b" " * (-len(head) % 4)
    with open(path, "wb") as out:
        out.write(struct.pack("<4sIIII", b"glTF", 2, 28 + len(head) + file.size, len(head), 0x4E4F534A))
        out.write(head)
        out.write(struct.pack("<II", file.size, 0x004E4942))
        out.writelines(file.chunks)
