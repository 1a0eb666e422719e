"""Meshes as trimesh, Open3D and meshio have them: imitations with the members of the real classes, and real ones where the libraries are
installed."""
import importlib

from scenes import np


class Trimesh:
    """trimesh.Trimesh: `triangles` are the places of the corners."""

    def __init__(self, vertices, faces):
        self.vertices, self.faces = np.asarray(vertices), np.asarray(faces)

    @property
    def triangles(self):
        return self.vertices[self.faces]


class TrimeshScene:
    """trimesh.Scene, which trimesh.load() returns for most files."""

    def __init__(self, mesh):
        self.geometry = {"geometry_0": mesh}

    @property
    def triangles(self):
        return self.to_mesh().triangles

    def to_mesh(self):
        return self.geometry["geometry_0"]


class Open3D:
    """open3d.geometry.TriangleMesh: vectors of C++, which are sequences and no arrays."""

    def __init__(self, vertices, triangles):
        self.vertices, self.triangles = np.asarray(vertices).tolist(), np.asarray(triangles).tolist()


class CellBlock:
    """meshio.CellBlock."""

    def __init__(self, kind, data):
        self.type, self.data = kind, np.asarray(data)


class Meshio:
    """meshio.Mesh."""

    def __init__(self, points, cells):
        self.points, self.cells = np.asarray(points), [CellBlock(*cell) for cell in cells]


def _real(name):
    """Returns a library, or None where it is not installed."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


def meshes(vertices, triangles):
    """Returns the mesh in all forms, by name."""
    cells = [("line", np.zeros((1, 2), int)), ("triangle", np.asarray(triangles, int))]
    forms = {"as trimesh": Trimesh(vertices, triangles), "as a scene of trimesh": TrimeshScene(Trimesh(vertices, triangles)),
             "as Open3D": Open3D(vertices, triangles), "as meshio": Meshio(vertices, cells)}
    trimesh, open3d, meshio = map(_real, ("trimesh", "open3d", "meshio"))
    if trimesh:
        forms["trimesh"] = trimesh.Trimesh(vertices, triangles, process=False)
        forms["scene of trimesh"] = trimesh.Scene([forms["trimesh"]])
    if open3d:
        vectors = open3d.utility.Vector3dVector(np.array(vertices)), open3d.utility.Vector3iVector(np.asarray(triangles, np.int32))
        forms["Open3D"] = open3d.geometry.TriangleMesh(*vectors)
    if meshio:
        forms["meshio"] = meshio.Mesh(vertices, cells)
    return forms
