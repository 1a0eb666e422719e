"""Cages that deform points. Experimental."""
from ctypes import byref

import numpy as np

from ._call import Options, call
from ._grid import Grid, voxelize_options
from ._library import ArgumentError, BindOptions, CageOptions, Unchanging, choice, counted, length, lib
from ._mesh import Mesh, face_count
from ._scene import arrays_of, mesh_arrays, points_of, scene_of

SYMMETRIES = ("auto", "off", "x", "y", "z")
KINDS = ("mean_value", "green", "maximum_likelihood")


def cage(scene, triangles=None, faces=None, *, margin=None, symmetry="auto", voxel=None, resolution=None, fill="flood", up=None, **run):
    """Makes a cage of quads around a scene, to deform with.

    cage(scene, ...)   as bplod --profile cage does:
      faces      most triangles; two of them make a quad: Mesh.quads. None: chosen, 1000 at most
      margin     least distance from the scene: a number in scene units, or "1%" of its diagonal; None: 0.5 %
      symmetry   "x", "y", "z": the cage is its own mirror image across that axis; "auto": if the scene is; "off"
      voxel, resolution, fill, up   as voxelize() has them
    cage(grid, faces)  around the scene of a Grid of voxelize() or close(), without a margin; a closed grid gives a smoother cage. The other
                       arguments mean nothing then. faces: 12 at least
    run  threads, memory, temp, device, progress (Options)
    Returns a Mesh that strictly encloses the scene. Cost: a second for 1000 faces, and the voxels.
    """
    if isinstance(scene, Grid):
        if triangles is not None and faces is None:
            triangles, faces = None, triangles
        if triangles is not None or margin is not None or symmetry != "auto" or (voxel, resolution, fill, up) != (None, None, "flood", None):
            raise ArgumentError("a cage of a grid takes a number of faces; give the scene for a margin or a symmetry")
        if faces is None:
            raise ArgumentError("faces: a cage of a grid needs a number of triangles")
        count = face_count(faces)
        handle, notes = call(Options(**run), "bp_cage", lambda r: (scene._handle.address, count, r), "bp_mesh_free")
        return Mesh(handle, 0, notes)
    options = CageOptions.made()
    options.faces = 0 if faces is None else face_count(faces)
    options.margin = length(margin, "margin")
    options.no_margin = margin is not None and options.margin.value == 0
    options.symmetry = choice(symmetry, SYMMETRIES, "symmetry")
    voxels = voxelize_options(voxel, resolution, fill, up)
    scene = scene_of(scene, triangles, copy=False)
    handle, notes = call(Options(**run), "bp_scene_cage", lambda r: (scene._handle.address, byref(voxels), byref(options), r), "bp_mesh_free")
    return Mesh(handle, 0, notes)


class Weights(Unchanging):
    """Points that are bound to a cage. len() is their number."""

    def __init__(self, handle, vertices):
        self._handle, self._vertices = handle, vertices

    def __repr__(self):
        return f"<bounding_proxies.Weights: {counted(len(self), 'point')} in a cage of {self._vertices} vertices>"

    def __len__(self):
        return lib().bp_weights_count(self._handle.address)

    def apply(self, vertices, out=None, **run):
        """Moves the points with the cage.

        vertices  (n, 3) the cage's vertices in their new places, scene units, in the same order
        out       (points, 3) float64 and contiguous, to be filled; None: a new array
        Returns the points' places, (points, 3).
        """
        moved = points_of(vertices, "vertices", self._vertices)
        if out is None:
            out = np.empty((len(self), 3))
        if not isinstance(out, np.ndarray):
            raise TypeError(f"out: {type(out).__name__} is no array of NumPy")
        if out.shape != (len(self), 3) or out.dtype != np.float64 or not out.flags.c_contiguous or not out.flags.writeable:
            raise ArgumentError(f"out: an array of {out.dtype} of shape {out.shape}; it must be contiguous, writeable float64 of {(len(self), 3)}")
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
    places = points_of(points, "points")
    handle, _ = call(Options(**run), "bp_bind", lambda r, _=kept: (byref(arrays), places.ctypes.data, len(places), byref(options), r), "bp_weights_free")
    return Weights(handle, len(kept[0]))
