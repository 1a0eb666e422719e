"""Writes scenes for the tools: PLY, and OBJ with materials and images where looks or glass matter. Vertices are moved to the world in double
precision and written as doubles, so the tools and their proofs speak of exactly these. Both formats keep Blender's axes: z is up. Nothing here
touches Blender's data."""
from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Iterator, TextIO

import numpy as np


@dataclass
class Part:
    """Triangles of one material. Arrays of corners have three rows for each triangle."""

    positions: np.ndarray  # (n, 3), float32, as Blender has them
    triangles: np.ndarray  # (m, 3), whole numbers
    material: int = -1  # of Scene.materials
    places: np.ndarray | None = None  # of corners, (3 m, 2)
    colors: np.ndarray | None = None  # of corners, (3 m, 3), linear
    normals: np.ndarray | None = None  # of corners, (3 m, 3)


@dataclass
class Material:
    """What the tools know of a material. Colours are linear. Images are numbers of Scene.images, by the keys of MTL."""

    color: list[float] = field(default_factory=lambda: [0.8, 0.8, 0.8])
    alpha: float = 1.0
    is_glass: bool = False
    roughness: float = 1.0
    metal: float = 0.0
    light: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    images: dict[str, int] = field(default_factory=dict)


@dataclass
class Scene:
    """Meshes, where they stand, their materials and images."""

    meshes: list[list[Part]] = field(default_factory=list)
    instances: list[tuple[int, np.ndarray]] = field(default_factory=list)  # a mesh, and its matrix, (4, 4)
    materials: list[Material] = field(default_factory=list)
    images: list[tuple[str, bytes]] = field(default_factory=list)  # ending and contents of image files
    comments: list[str] = field(default_factory=list)  # what a file of the tools tells of itself

    @property
    def triangles(self) -> int:
        return sum(len(part.triangles) for mesh, _ in self.instances for part in self.meshes[mesh])

    def in_world(self) -> Iterator[tuple[Part, np.ndarray, list[int], np.ndarray]]:
        """Yields each part with its vertices in the world, the order of a triangle's corners, and the matrix. Matrices that mirror turn triangles
        over: Blender shows the same side of them as before."""
        for mesh, matrix in self.instances:
            order = [2, 1, 0] if np.linalg.det(matrix[:3, :3]) < 0 else [0, 1, 2]
            for part in self.meshes[mesh]:
                yield part, to_world(matrix, part.positions), order, matrix


def to_world(matrix: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """Multiplies step by step, since products of matrices may add in another order from run to run, and the last digit must not change."""
    x, y, z = positions.astype(float).T
    return np.stack([matrix[i, 0] * x + matrix[i, 1] * y + matrix[i, 2] * z + matrix[i, 3] for i in range(3)], axis=1)


def write_ply(path: Path, scene: Scene) -> None:
    vertices, faces, begin = [], [], 0
    for part, positions, order, _ in scene.in_world():
        vertices.append(positions)
        faces.append(part.triangles[:, order].astype(np.int64) + begin)
        begin += len(positions)
    all_faces = np.concatenate(faces) if faces else np.zeros((0, 3), int)
    rows = np.empty(len(all_faces), [("count", "u1"), ("corners", "<u4", 3)])
    rows["count"], rows["corners"] = 3, all_faces
    head = ["ply", "format binary_little_endian 1.0"] + [f"comment {line}" for line in scene.comments] + [f"element vertex {begin}"]
    head += [f"property double {axis}" for axis in "xyz"]
    head += [f"element face {len(rows)}", "property list uchar uint vertex_indices", "end_header", ""]
    with open(path, "wb") as out:
        out.write("\n".join(head).encode())
        for positions in vertices:
            out.write(positions.astype("<f8").tobytes())
        out.write(rows.tobytes())


def write_obj(path: Path, scene: Scene) -> None:
    """Writes the scene with its materials beside it, and its images."""
    for i, (ending, contents) in enumerate(scene.images):
        path.with_name(_image_name(scene, i)).write_bytes(contents)
    path.with_suffix(".mtl").write_text("".join(_material_text(scene, i) for i in range(len(scene.materials))), encoding="ascii")
    counts = [1, 1, 1]  # of the next vertex, place and normal
    with open(path, "w", encoding="ascii") as out:
        out.writelines(f"# {line}\n" for line in scene.comments)
        out.write(f"mtllib {path.stem}.mtl\n")
        for part, positions, order, matrix in scene.in_world():
            _write_part(out, part, positions, order, matrix, counts)


def _write_part(out: TextIO, part: Part, positions: np.ndarray, order: list[int], matrix: np.ndarray, counts: list[int]) -> None:
    corners = np.arange(part.triangles.size).reshape(-1, 3)[:, order]
    if part.colors is not None:  # colours belong to vertices there, and to corners here
        rows = np.concatenate([positions[part.triangles.reshape(-1)], srgb(part.colors)], axis=1)
        vertices = corners + counts[0]
    else:
        rows, vertices = positions, part.triangles[:, order] + counts[0]
    out.writelines("v " + " ".join(map(repr, row)) + "\n" for row in rows.tolist())
    columns = [vertices]
    if part.places is not None:
        out.writelines("vt %.7g %.7g\n" % tuple(row) for row in part.places.tolist())
        columns.append(corners + counts[1])
        counts[1] += len(part.places)
    if part.normals is not None:
        turned = part.normals.astype(float) @ np.linalg.pinv(matrix[:3, :3])
        out.writelines("vn %.6g %.6g %.6g\n" % tuple(row) for row in turned.tolist())
        columns.append(corners + counts[2])
        counts[2] += len(part.normals)
    counts[0] += len(rows)
    out.write(f"usemtl m{part.material}\n" if part.material >= 0 else "usemtl none\n")
    separator = "//" if part.places is None and part.normals is not None else "/"
    corner = separator.join(["%d"] * len(columns))
    face = f"f {corner} {corner} {corner}\n"
    out.writelines(face % tuple(row) for row in np.stack(columns, axis=2).reshape(len(corners), -1).tolist())


def _image_name(scene: Scene, i: int) -> str:
    return f"image{i}.{scene.images[i][0]}"


def _material_text(scene: Scene, i: int) -> str:
    material = scene.materials[i]
    lines = [f"newmtl m{i}", "Kd %.6g %.6g %.6g" % tuple(srgb(np.array(material.color))), f"Pr {material.roughness:.6g}", f"Pm {material.metal:.6g}"]
    if any(material.light):
        lines.append("Ke %.6g %.6g %.6g" % tuple(srgb(np.array(material.light))))
    if material.alpha < 1 or material.is_glass:
        lines.append(f"d {min(material.alpha, 0.999):.6g}")
    lines += [f"{key} {_image_name(scene, image)}" for key, image in material.images.items()]
    return "\n".join(lines) + "\n\n"


def srgb(linear: np.ndarray) -> np.ndarray:
    """Returns linear colours as files have them."""
    linear = np.clip(linear, 0, 1)
    return np.where(linear < 0.0031308, linear * 12.92, 1.055 * np.power(linear, 1 / 2.4) - 0.055)
