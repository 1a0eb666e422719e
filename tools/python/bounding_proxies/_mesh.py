"""Proxies and other meshes."""
from ctypes import byref, c_double, c_uint32, c_uint64

import numpy as np

from ._call import Options, call
from ._grid import Grid, close_options, voxelize_options
from ._library import (ArgumentError, HullsOptions, MeshInfo, MeshOptions, MeshView, Unchanging, check, choice, counted, factor, length, lib, needed,
                       path_bytes, read_struct, sunk, text, whole, write_all)
from ._scene import scene_of

MODES = ("auto", "bounding", "fit", "inside")
ENCLOSE = ("auto", "scene", "input", "closing")


def _array(address, rows, columns, kind, dtype, owner):
    """Returns an array in the memory of `owner`, which it keeps alive."""
    if rows == 0:
        return np.empty((0, columns), dtype)
    memory = (kind * (rows * columns)).from_address(address)
    memory.owner = owner
    return np.frombuffer(memoryview(memory).toreadonly(), dtype).reshape(rows, columns)


class Mesh(Unchanging):
    """A triangle mesh of the library. It does not change.

    vertices   (n, 3) float64, scene units, exact; read-only, in the library's memory: copy() it to change it
    triangles  (m, 3) uint32, from 0, counter-clockwise seen from outside; faces is another name of it
    quads      (q, 2) uint32: pairs of triangles that make a quad together
    volume, area   scene units cubed and squared
    error_bound    no point of a proxy is farther from what it encloses, scene units; 0: not bounded
    enclosed       what lies strictly inside: "scene", "input" (its voxels), "closing"; "" if nothing is known to
    stopped_by     the target that was reached first: "faces", "error", "volume"; "least-volume": further faces would save next to no volume;
                   else the reason in words. "" for other meshes
    notes          sentences of the library that are worth a look: what was left out, why a target was not reached
    """

    def __init__(self, handle, index=0, notes=()):
        self._handle, self._index, self.notes = handle, index, list(notes)
        v = read_struct(MeshView, "bp_mesh_look", handle.address, index)
        self.vertices = _array(v.vertices, v.vertex_count, 3, c_double, np.float64, handle)
        self.triangles = _array(v.triangles, v.triangle_count, 3, c_uint32, np.uint32, handle)
        self.quads = _array(v.quads, v.quad_count, 2, c_uint32, np.uint32, handle)
        i = read_struct(MeshInfo, "bp_mesh_read_info", handle.address, index)
        self.volume, self.area, self.error_bound = i.volume, i.area, i.error_bound
        self.stopped_by, self.enclosed = i.stopped_by.decode(), i.enclosed.decode()

    @property
    def faces(self):
        return self.triangles

    def __repr__(self):
        return f"<bounding_proxies.Mesh: {len(self.vertices)} vertices, {counted(len(self.triangles), 'triangle')}>"

    def save(self, path, *, overwrite=False, format=None):
        """Writes the mesh without loss as .glb, .gltf, .ply, .obj or .stl, with the bytes that the tools write.

        path    a name, which tells the format, or an object with write(), such as io.BytesIO()
        format  of an object: "glb", "gltf", "ply", "obj" or "stl"
        """
        if hasattr(path, "write"):
            if format is None:
                raise ArgumentError('format: name the one to be written, such as format="glb"')
            kind = text(format, "format")
            sunk(lambda _, data: write_all(path, data), lambda sink: check(lib().bp_mesh_write(self._handle.address, self._index, kind, sink, None)))
            return
        if format is not None:
            raise ArgumentError(f"format: {format!r} is given beside the name of a file, which tells the format")
        check(lib().bp_mesh_save(self._handle.address, self._index, path_bytes(path, "path"), bool(overwrite)))


def face_count(count):
    try:
        number = int(count)
        is_count = (isinstance(count, str) or number == count) and 0 < number < 2**63
    except (TypeError, ValueError, OverflowError):
        is_count = False
    if not is_count:
        raise ArgumentError(f"faces: {count!r} is no number of triangles; write faces=400, or faces=[400, 100] for several levels")
    return number


def face_list(faces):
    """Returns the numbers of several levels, of a list or of a text as the tools take it ("400,100"); None: there is one level."""
    if isinstance(faces, str):
        faces = faces.split(",") if "," in faces else faces
    return None if faces is None or np.ndim(faces) == 0 else list(faces)


def face_counts(faces):
    """Returns numbers of triangles as an array of ctypes, and how many there are."""
    several = face_list(faces)
    counts = [face_count(count) for count in ([faces] if several is None else several)]
    return (c_uint64 * len(counts))(*counts), len(counts)


def meshes_of(handle, notes):
    return [Mesh(handle, i, notes) for i in range(lib().bp_mesh_count(handle.address))]


def mesh_options(faces=None, error=None, volume=None, mode="auto", enclose="auto", quads=False):
    options = MeshOptions.made()
    if faces is not None:
        options.faces, options.levels = face_counts(faces)
    options.error = length(error, "error")
    options.volume = 0 if volume is None else factor(volume, "volume")
    options.mode = choice(mode, MODES, "mode")
    options.enclose = choice(enclose, ENCLOSE, "enclose")
    options.quads = bool(quads)
    return options


def _one_or_all(faces, meshes):
    return meshes[0] if face_list(faces) is None else meshes


def mesh(grid, faces=None, *, error=None, volume=None, mode="auto", enclose="auto", quads=False, **run):
    """Meshes the closing of a grid, or its solid layer, and simplifies it, after [CB17] section 3.4.

    faces    most triangles; a list of falling numbers, or a text such as "400,100", makes as many levels, each of which strictly encloses the one before
    error    largest distance to what is enclosed: a number in scene units, or "0.5%", or "2vx"
    volume   largest volume, as a multiple of the voxels' volume
    mode     "bounding": strictly around; "fit": near the surface; "inside"; "auto": bounding, or inside for grids of fill "inside"
    enclose  "auto": the scene's triangles if they are no more than 2^20 and can be had; "scene"; "input": its voxels; "closing"
    quads    join triangles to quads
    run      threads, memory, temp, device, progress (Options)
    Returns a Mesh: closed, 2-manifold, free of self-intersections. Returns a list of them if faces is a list.
    """
    needed(grid, Grid, "voxelize() or close()")
    options = mesh_options(faces, error, volume, mode, enclose, quads)
    handle, notes = call(Options(**run), "bp_mesh_make", lambda r: (grid._handle.address, byref(options), r), "bp_mesh_free")
    return _one_or_all(faces, meshes_of(handle, notes))


def proxy(scene, triangles=None, faces=1000, scale=None, *, voxel=None, resolution=None, fill="flood", up=None, rules=None, element="cube",
          keep_cavities=False, error=None, volume=None, mode="auto", enclose="auto", quads=False, **run):
    """Makes a bounding proxy: voxelize(), close() and mesh() in one call, as `bpvox | bpclose | bpmesh` do.

    scene, triangles  what Scene takes: proxy(vertices, triangles), proxy(mesh), proxy("scene.glb")
    faces       most triangles; a list of falling numbers makes as many levels. None: the other targets decide
    scale       closing radius: gaps narrower than twice this are filled. A number in scene units, or "1%" of the scene's diagonal; None: 2 %
    resolution  voxels along the longest side of the scene, or voxel: the edge of one; default 256. They bound how near the proxy can come
    error       largest distance to the scene, a number or "0.5%"; volume: the largest one, as a multiple of the voxels'
    rules, element, keep_cavities as close() has them, fill and up as voxelize(), mode, enclose and quads as mesh()
    run         threads, memory, temp, device, progress (Options)
    Raises InputError, ArgumentError, ResourceError.
    Returns a Mesh that strictly encloses every triangle of the scene. Returns a list of them, finest first, if faces is a list.
    """
    voxels = voxelize_options(voxel, resolution, fill, up)
    closing = close_options(scale, rules, element, keep_cavities)
    options = mesh_options(faces, error, volume, mode, enclose, quads)
    scene = scene_of(scene, triangles, copy=False)
    handle, notes = call(Options(**run), "bp_proxy", lambda r: (scene._handle.address, byref(voxels), byref(closing), byref(options), r),
                         "bp_mesh_free")
    return _one_or_all(faces, meshes_of(handle, notes))


def load(path, **run):
    """Reads a file of a mesh. Returns its levels, finest first, as a list. Vertices of equal coordinates become one."""
    return meshes_of(*call(Options(**run), "bp_mesh_load", lambda r: (path_bytes(path, "path"), r), "bp_mesh_free"))


def hulls(mesh, hulls=0, *, faces=0, corners=0, **run):
    """Covers a proxy with convex hulls that together enclose exactly what it encloses, after [WLLS22] and [MG09]. Experimental.

    mesh     of mesh() or proxy()
    hulls    at most so many; 0: 32, or 64 where these hold clearly less
    faces    of all hulls together; 0: no limit
    corners  of a hull, 8 to 64; 0: 64, which physics engines take
    Returns a list of Mesh.
    """
    needed(mesh, Mesh, "mesh() or proxy()")
    options = HullsOptions.made()
    options.hulls, options.faces, options.corners = whole(hulls, "hulls"), whole(faces, "faces", below=2**63), whole(corners, "corners")
    return meshes_of(*call(Options(**run), "bp_hulls", lambda r: (mesh._handle.address, mesh._index, byref(options), r), "bp_mesh_free"))
