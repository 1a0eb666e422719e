"""Scenes: arrays, files, and objects of other libraries."""
import os
from ctypes import byref, c_char_p, c_void_p, sizeof

import numpy as np

from ._call import Options, call
from ._library import ArgumentError, Arrays, Handle, SceneInfo, Unchanging, check, choice, lib, path_bytes, text

UPS = ("unknown", "y", "z", "x", "-x", "-y", "-z")
_TYPES = {"f8": 0, "f4": 1, "u4": 2, "i4": 3, "u8": 4, "i8": 5}


def _rows(array, name, kinds, wanted):
    """Returns the array as rows of three numbers that the library reads in place, or a copy where it cannot. kinds: of NumPy's dtypes."""
    try:
        array = np.asarray(array)
    except ValueError as e:  # rows of several lengths
        raise ArgumentError(f"{name}: no array: {e}") from None
    if array.dtype.kind not in kinds:
        raise TypeError(f"{name}: an array of {array.dtype}; it must hold {wanted}")
    if array.ndim != 2 or array.shape[1] != 3:
        hint = "; split polygons into triangles" if name == "triangles" and array.ndim == 2 and array.shape[1] > 3 else ""
        raise ArgumentError(f"{name}: an array of shape {array.shape}; the shape must be (n, 3){hint}")
    code = array.dtype.str[1:]
    known = code in (("u4", "i4", "u8", "i8") if name == "triangles" else ("f8", "f4"))
    if not known or not array.dtype.isnative:
        code = code if known else "f8" if name == "vertices" else array.dtype.kind + "4"
        array = array.astype(np.dtype(code))
    item = array.itemsize
    if len(array) and (array.strides[1] != item or array.strides[0] < 3 * item):
        array = np.ascontiguousarray(array)
    return array, _TYPES[code]


def arrays_of(vertices, triangles, up=None):
    """Returns the struct of two arrays, and what must be kept while it is used."""
    vertices, vertex_type = _rows(vertices, "vertices", "fiu", "real numbers")
    triangles, triangle_type = _rows(triangles, "triangles", "iu", "whole numbers")
    arrays = Arrays.made()
    arrays.vertices, arrays.vertex_count, arrays.vertex_type = vertices.ctypes.data, len(vertices), vertex_type
    arrays.triangles, arrays.triangle_count, arrays.triangle_type = triangles.ctypes.data, len(triangles), triangle_type
    arrays.vertex_stride = vertices.strides[0] if len(vertices) > 1 else 0
    arrays.triangle_stride = triangles.strides[0] if len(triangles) > 1 else 0
    arrays.up = choice("unknown" if up is None else up, UPS, "up")
    return arrays, (vertices, triangles)


def points_of(points, name, count=None):
    """Returns points as an array that the library reads. count: the number that a cage wants."""
    array = np.asarray(points)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: an array of {array.dtype}; it must hold real numbers")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ArgumentError(f"{name}: an array of shape {array.shape}; the shape must be (n, 3)")
    if count is not None and len(array) != count:
        raise ArgumentError(f"{name}: an array of {len(array)} rows, and the number of the cage's vertices is {count}")
    return np.ascontiguousarray(array, np.float64)


def _cells(mesh):
    """Returns the triangles of a meshio object."""
    blocks = [np.asarray(block.data) for block in mesh.cells if block.type == "triangle"]
    other = sorted({block.type for block in mesh.cells} - {"triangle", "vertex", "line"})
    if other:
        raise ArgumentError(f"cells of {', '.join(other)} are no triangles; convert them first")
    if not blocks:
        raise ArgumentError("the mesh has no cells of triangles")
    return np.concatenate(blocks)


def mesh_arrays(thing):
    """Returns vertices and triangles of a mesh object: (vertices, triangles), objects of trimesh, Open3D and meshio, and Mesh. None: it is
    none."""
    if isinstance(thing, tuple) and len(thing) == 2:
        return thing
    if hasattr(thing, "geometry") and hasattr(thing, "to_mesh"):  # a Scene of trimesh, which trimesh.load() returns for most files
        thing = thing.to_mesh()
    if hasattr(thing, "vertices"):
        for name in ("faces", "triangles"):  # a Trimesh has both, and its triangles are the places of their corners
            if hasattr(thing, name):
                return np.asarray(thing.vertices), np.asarray(getattr(thing, name))
    if hasattr(thing, "points") and hasattr(thing, "cells"):
        return np.asarray(thing.points), _cells(thing)
    return None


def is_path(thing):
    return isinstance(thing, (str, os.PathLike))


def _refuse_triangles_beside(scene, triangles):
    """Refuses triangles beside what has triangles itself, such as the number in proxy("scene.glb", 500)."""
    number = isinstance(triangles, (int, float, str)) or np.ndim(triangles) == 0
    if number or is_path(scene) or isinstance(scene, Scene) or hasattr(scene, "vertices") or hasattr(scene, "points"):
        what = repr(triangles) if number else f"a second {type(triangles).__name__}"
        raise ArgumentError(f"triangles: {what} is given beside {type(scene).__name__}; write other arguments by their names, such as faces=1000")


class Scene(Unchanging):
    """Triangles to enclose.

    Scene(vertices, triangles)   arrays: vertices (n, 3) of real numbers in scene units, triangles (m, 3) of whole numbers, from 0,
                                 counter-clockwise seen from outside
    Scene(mesh)                  an object with .vertices and .faces or .triangles (trimesh, Open3D), or with .points and .cells (meshio);
                                 a Scene of trimesh
    Scene(path), Scene([path])   files, voxelized together: PLY, STL, OBJ, OFF, glTF, GLB, tilesets, and what Assimp reads. They are
                                 streamed when they are needed, from the current folder of that moment, and may be larger than memory

    up: the axis that points up, "y", "z", "-x", ...; None: what the scene tells, else y.
    copy: False keeps references to the arrays, which must not change then. A change after voxelize() is reported.
    Raises InputError with the number of the first fault if a vertex that is used is not finite, or a triangle names a vertex that does not
    exist; ValueError and TypeError for arrays of a wrong shape or type.
    """

    def __init__(self, scene, triangles=None, *, up=None, copy=True, format=None):
        self._kept = None
        out = c_void_p()
        if triangles is not None:
            _refuse_triangles_beside(scene, triangles)
        if triangles is None and (is_path(scene) or (isinstance(scene, list) and scene and all(map(is_path, scene)))):
            paths = [path_bytes(p, "the name of a file") for p in ([scene] if is_path(scene) else scene)]
            list_of_paths = (c_char_p * len(paths))(*paths)
            check(lib().bp_scene_from_files(list_of_paths, len(paths), None if format is None else text(format, "format"), byref(out)))
        else:
            pair = (scene, triangles) if triangles is not None else mesh_arrays(scene)
            if pair is None:
                raise TypeError(f"{type(scene).__name__} is no scene: give vertices and triangles, a path, or an object with .vertices and .faces")
            arrays, kept = arrays_of(*pair, up)
            arrays.borrow = 0 if copy else 1
            if not copy:
                self._kept = kept
            check(lib().bp_scene_from_arrays(byref(arrays), None, byref(out)))
        self._handle = Handle(out.value, "bp_scene_free")

    def info(self, **run):
        """Reads the whole scene. Returns triangles, degenerate, non_finite and bad_faces as numbers, and the corners of the bounding box."""
        out = SceneInfo()
        call(Options(**run), "bp_scene_read_info", lambda r: (self._handle.address, r, byref(out), sizeof(out)))
        return {"triangles": out.triangles, "degenerate": out.degenerate, "non_finite": out.non_finite, "bad_faces": out.bad_faces,
                "min": np.array(out.min), "max": np.array(out.max)}


def scene_of(scene, triangles=None, **how):
    """Returns a Scene as it is, or makes one."""
    return scene if isinstance(scene, Scene) and triangles is None else Scene(scene, triangles, **how)
