"""Cages that deform points. Experimental."""
from ctypes import byref

import numpy as np

from ._call import Options, call
from ._library import ArgumentError, BindOptions, choice, lib
from ._mesh import Mesh
from ._scene import arrays_of, mesh_arrays

KINDS = ("mean_value", "green", "maximum_likelihood")


def _points(points, name, count=None):
    array = np.asarray(points)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: an array of {array.dtype}; it must hold real numbers")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name}: an array of shape {array.shape}; the shape must be (n, 3)")
    if count is not None and len(array) != count:
        raise ArgumentError(f"{name}: {len(array)} vertices, and the cage has {count}")
    return np.ascontiguousarray(array, np.float64)


def cage(grid, faces, **run):
    """Makes a cage of nothing but quads around the scene of a grid.

    grid   of voxelize() or close(); a closed one gives a smoother cage
    faces  most triangles, 12 at least; two of them make a quad: Mesh.quads
    run    threads, memory, temp, device, progress (Options)
    Returns a Mesh that strictly encloses the scene. Cost: a second for 1000 faces.
    """
    if int(faces) != faces or not 0 < faces < 2**63:
        raise ArgumentError(f"faces: {faces!r} is no number of triangles")
    handle, notes = call(Options(**run), "bp_cage", lambda r: (grid._handle.address, int(faces), r), "bp_mesh_free")
    return Mesh(handle, 0, notes)


class Weights:
    """Points that are bound to a cage. len() is their number."""

    def __init__(self, handle, vertices):
        self._handle, self._vertices = handle, vertices

    def __len__(self):
        return lib().bp_weights_count(self._handle.address)

    def apply(self, vertices, out=None, **run):
        """Moves the points with the cage.

        vertices  (n, 3) the cage's vertices in their new places, scene units, in the same order
        out       (points, 3) float64 and contiguous, to be filled; None: a new array
        Returns the points' places, (points, 3).
        """
        moved = _points(vertices, "vertices", self._vertices)
        if out is None:
            out = np.empty((len(self), 3))
        if out.shape != (len(self), 3) or out.dtype != np.float64 or not out.flags.c_contiguous or not out.flags.writeable:
            raise ValueError(f"out: an array of {out.dtype} of shape {out.shape}; it must be contiguous, writeable float64 of {(len(self), 3)}")
        call(Options(**run), "bp_weights_apply", lambda r: (self._handle.address, moved.ctypes.data, r, out.ctypes.data))
        return out


def bind(cage, points, kind="mean_value", *, carry_outside=False, **run):
    """Binds points to a cage.

    cage           a closed mesh around the points, such as a proxy: a Mesh, (vertices, triangles), or an object as Scene takes
    points         (n, 3) real numbers, scene units
    kind           "mean_value" [JSW05], "green" [LLC08], which keeps angles better, or "maximum_likelihood" [CDH23]
    carry_outside  points outside follow the cage's nearest point; else they are an InputError
    run            threads, memory, temp, progress (Options)
    Returns Weights. Memory: 4 bytes for each point and vertex of the cage. Cost: microseconds for each point and 300 faces.
    """
    options = BindOptions.made()
    options.kind, options.carry_outside = choice(kind, KINDS, "kind"), bool(carry_outside)
    pair = mesh_arrays(cage)
    if pair is None:
        raise TypeError(f"{type(cage).__name__} is no cage: give a Mesh, (vertices, triangles), or an object with .vertices and .faces")
    arrays, kept = arrays_of(*pair)
    places = _points(points, "points")
    handle, _ = call(Options(**run), "bp_bind", lambda r: (byref(arrays), places.ctypes.data, len(places), byref(options), r), "bp_weights_free")
    return Weights(handle, len(kept[0]))
