"""Voxels of a scene, and their closing."""
import json
from ctypes import byref, c_size_t

import numpy as np

from ._call import Options, call
from ._library import (ArgumentError, CloseOptions, GridInfo, Unchanging, VoxelizeOptions, check, choice, length, lib, needed, path_bytes, read_struct, sunk, text, write_all,
                       whole)
from ._scene import UPS, points_of, scene_of

FILLS = ("flood", "winding", "none", "inside")
ELEMENTS = ("cube", "ball")
LAYERS = ("solid", "closing")
BRICK = 64


def voxelize_options(voxel=None, resolution=None, fill="flood", up=None):
    options = VoxelizeOptions.made()
    options.voxel = length(voxel, "voxel")
    if voxel is not None and not options.voxel.value > 0:
        raise ArgumentError(f"voxel: {voxel!r} is no length above 0; leave it out for voxels by resolution")
    options.resolution = 0 if resolution is None else whole(resolution, "resolution", 1)
    options.fill = choice(fill, FILLS, "fill")
    options.up = choice("unknown" if up is None else up, UPS, "up")
    return options


def rules_text(rules):
    return text(rules if isinstance(rules, str) else json.dumps(rules), "rules")


def close_options(scale=None, rules=None, element="cube", keep_cavities=False):
    options = CloseOptions.made()
    options.scale = length(scale, "scale")
    options.no_scale = scale is not None and options.scale.value == 0
    if rules is not None:
        options.rules = rules_text(rules)
    options.element = choice(element, ELEMENTS, "element")
    options.keep_cavities = bool(keep_cavities)
    return options


def _place(coord, name):
    """Returns the coordinates of a voxel or a brick, (3,)."""
    try:
        numbers = [whole(x, name, -2**31, 2**31) for x in coord]
    except TypeError:
        numbers = []
    if len(numbers) != 3:
        raise ArgumentError(f"{name}: {coord!r} are not three whole numbers")
    return np.array(numbers, np.int64)


class Grid(Unchanging):
    """Voxels: the solid layer and, after close(), the closing. A grid does not change.

    voxel    edge of a voxel, scene units
    origin   (3,) corner of voxel (0, 0, 0), scene units: voxel (i, j, k) covers origin + voxel * (i, j, k) .. origin + voxel * (i+1, ...)
    min, max (3,) all voxels that are set lie in min <= v < max; may be negative
    bounds   (2, 3) bounding box of the scene, scene units
    scale    of the closing where it is the same everywhere, scene units; else 0
    rules    the scale field of the closing, or of the closing to come, as a dict of rules in scene units; None: there is none
    bricks, voxels  numbers of bricks and voxels that are not empty, by layer: {"solid": n, "closing": n}
    notes    sentences of the library that are worth a look
    """

    def __init__(self, handle, notes=(), scene=None):
        self._handle, self.notes = handle, list(notes)
        self._scene = scene  # its arrays may be borrowed
        self._info = None

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        if self._info is None:
            i = read_struct(GridInfo, "bp_grid_read_info", self._handle.address)
            self._info = {"voxel": i.voxel, "origin": np.array(i.origin), "min": np.array(i.min), "max": np.array(i.max),
                          "bounds": np.array([list(i.bounds_min), list(i.bounds_max)]), "has_closing": bool(i.has_closing),
                          "fill": FILLS[i.fill], "up": UPS[i.up], "scale": i.scale, "bricks": dict(zip(LAYERS, i.bricks)),
                          "voxels": dict(zip(LAYERS, i.voxels)), "rules": json.loads(i.rules) if i.rules else None}
        try:
            return self._info[name]
        except KeyError:
            raise AttributeError(f"a Grid has no {name!r}; it has {', '.join(self._info)}") from None

    def __repr__(self):
        layer = "closing" if self.has_closing else "solid"
        return f"<bounding_proxies.Grid: {self.voxels[layer]} voxels of {self.voxel:.4g} in its {layer} layer>"

    def __dir__(self):
        self.voxel
        return [*super().__dir__(), *self._info]

    def field(self, rules, **run):
        """Adds a scale field, as bpscale does: rules say for each place how large the gaps are that close() closes there.

        rules  JSON or a dict as docs/bpscale.1.md has it, with an orientation, too. Names of parts need a scene of files
        run    threads, memory, temp, progress (Options)
        Returns a Grid with the same voxels, and with the field in place of one that this grid has. close() takes it without scale and rules.
        """
        handle, notes = call(Options(**run), "bp_field", lambda r: (self._handle.address, rules_text(rules), r), "bp_grid_free")
        return Grid(handle, notes, self._scene)

    def scales(self, points, **run):
        """Returns the scales at points, (n,): the closing radius there by the field of this grid, scene units.

        points  (n, 3) real numbers, scene units
        """
        places = points_of(points, "points")
        out = np.empty(len(places))
        call(Options(**run), "bp_grid_scales", lambda r: (self._handle.address, places.ctypes.data, len(places), r, out.ctypes.data))
        return out

    def close(self, scale=None, *, rules=None, element="cube", keep_cavities=False, **run):
        """Closes the solid layer, after [CB17] section 3.3: gaps, holes and grooves narrower than twice the scale are filled.

        scale          radius: a number in scene units, or "2%" of the scene's diagonal, or "20vx". Default: the field() of the grid, else 2 %
        rules          scales that differ from place to place, in place of scale: JSON or a dict as docs/bpscale.1.md has it
        element        "cube" keeps large flat areas; "ball"
        keep_cavities  hollows that the closing cuts off from the outside stay empty
        run            threads, memory, temp, device, progress (Options)
        Returns a Grid. This one stays as it is.
        """
        options = close_options(scale, rules, element, keep_cavities)
        handle, notes = call(Options(**run), "bp_close", lambda r: (self._handle.address, byref(options), r), "bp_grid_free")
        return Grid(handle, notes, self._scene)

    def mesh(self, faces=None, **how):
        """Meshes the grid: mesh(grid, faces, ...)."""
        from ._mesh import mesh
        return mesh(self, faces, **how)

    def dense(self, layer=None, min=None, max=None):
        """Returns voxels as an array of bool of shape (z, y, x): element [k, j, i] is voxel min + (i, j, k).

        layer     "solid" or "closing"; None: the closing if there is one
        min, max  (3,) corners of the box of voxels, min <= v < max; default: self.min, self.max. A byte for each voxel
        """
        if layer is None:
            layer = "closing" if self.has_closing else "solid"
        low, high = _place(self.min if min is None else min, "min"), _place(self.max if max is None else max, "max")
        extent = high - low
        if (extent < 0).any() or extent.max() >= 2**31:
            raise ArgumentError(f"min {low.tolist()} and max {high.tolist()} are no box of voxels")
        out = np.empty(extent[::-1], np.uint8)
        corner, size = low.astype(np.int32), extent.astype(np.int32)
        check(lib().bp_grid_read(self._handle.address, choice(layer, LAYERS, "layer"), corner.ctypes.data, size.ctypes.data, out.ctypes.data))
        return out.view(bool)

    def brick_coords(self, layer="solid"):
        """Returns the coordinates of the bricks that are not empty, (n, 3), sorted. Brick b holds voxels 64 b .. 64 b + 63."""
        number, count = choice(layer, LAYERS, "layer"), c_size_t()
        check(lib().bp_grid_bricks(self._handle.address, number, None, 0, byref(count)))
        out = np.empty((count.value, 3), np.int32)
        check(lib().bp_grid_bricks(self._handle.address, number, out.ctypes.data, count.value, byref(count)))
        return out

    def brick(self, coord, layer="solid"):
        """Returns one brick as an array of uint64 of shape (64, 64): bit i of [k, j] is voxel (i, j, k) of the brick."""
        place = _place(coord, "coord").astype(np.int32)
        out = np.empty((BRICK, BRICK), np.uint64)
        check(lib().bp_grid_brick(self._handle.address, choice(layer, LAYERS, "layer"), place.ctypes.data, out.ctypes.data))
        return out

    def save(self, path, *, overwrite=False, **run):
        """Writes the stream of voxels that the tools read (docs/brick-stream.md). The file appears complete or not at all.

        path  a name, or an object with write(), which gets the bytes on a thread of the library while this one waits
        """
        if hasattr(path, "write"):
            sunk(lambda _, data: write_all(path, data), lambda sink: call(Options(**run), "bp_grid_write", lambda r: (self._handle.address, sink, None, r)))
            return
        call(Options(**run), "bp_grid_save", lambda r: (self._handle.address, path_bytes(path, "path"), bool(overwrite), r))


def voxelize(scene, triangles=None, *, voxel=None, resolution=None, fill="flood", up=None, **run):
    """Sets every voxel that a triangle touches, and fills the inside, after [SS10].

    scene, triangles  what Scene takes
    voxel       edge of a voxel: a number in scene units, or "0.5%" of the scene's diagonal
    resolution  voxels along the longest side of the scene, in place of voxel; default 256
    fill        "flood": all that the outside cannot reach; "winding"; "none"; "inside": for a proxy inside the scene
    up          the axis that points up: "y", "z", ...
    run         threads, memory, temp, device, progress (Options)
    Returns a Grid. Cost: linear in the triangles, and in the voxels that they touch.
    """
    options = voxelize_options(voxel, resolution, fill, up)
    scene = scene_of(scene, triangles)
    handle, notes = call(Options(**run), "bp_voxelize", lambda r: (scene._handle.address, byref(options), r), "bp_grid_free")
    return Grid(handle, notes, scene)


def field(grid, rules, **run):
    """Adds a scale field to a grid: grid.field(rules, ...)."""
    return needed(grid, Grid, "voxelize() or load_grid()").field(rules, **run)


def close(grid, scale=None, **how):
    """Closes a grid: grid.close(scale, ...)."""
    return needed(grid, Grid, "voxelize() or load_grid()").close(scale, **how)


def load_grid(path, **run):
    """Reads a stream of voxels that bpvox or bpclose wrote, or Grid.save()."""
    handle, notes = call(Options(**run), "bp_grid_load", lambda r: (path_bytes(path, "path"), r), "bp_grid_free")
    return Grid(handle, notes)
