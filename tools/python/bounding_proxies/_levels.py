"""Levels of detail, and occluders, of a scene. Experimental."""
from ctypes import byref

import numpy as np

from ._call import Options, call
from ._grid import voxelize_options
from ._library import Length, LevelsOptions, OccluderOptions, check, choice, length, lib, path_bytes, sunk, text, whole
from ._mesh import ENCLOSE, Mesh, face_count, face_counts, meshes_of
from ._scene import scene_of

MODES = ("auto", "bounding", "fit")


def levels(scene, triangles=None, faces=None, *, error=None, levels=None, scale=None, mode="bounding", enclose="auto", voxel=None,
           resolution=None, fill="flood", up=None, **run):
    """Makes levels of detail of a scene, as bplod does, without colours and textures. Experimental.

    scene, triangles  what Scene takes
    faces    most triangles of the finest level, and each other one gets a quarter of those before; or a list of falling numbers
    error    in place of faces: largest distance of the finest level to the scene, which doubles from level to level; or a list of rising
             ones. Numbers in scene units, or texts such as "0.5%". Neither: the scene decides
    levels   at most so many; None: as many as are listed, else 4, or fewer
    scale    closing radius of the finest level, which doubles from level to level; None: chosen
    mode     "bounding": each level strictly encloses the scene; "fit": near the surface
    enclose  "auto", "scene", "input" or "closing", as mesh() has it
    voxel, resolution, fill, up  as voxelize() has them; without voxel and resolution the voxels follow from faces or error
    run      threads, memory, temp, device, progress (Options)
    Returns a list of Mesh, finest first: each has fewer triangles than the level before, and a larger error (Mesh.error_bound). A level that
    is not worth having is left out, and Mesh.notes tell why. save_levels() writes their files. Cost: seconds to a minute.
    """
    options = LevelsOptions.made()
    if faces is not None:
        options.faces, options.face_count = face_counts(faces)
    if error is not None:
        errors = [error] if np.ndim(error) == 0 else error
        lengths = [length(e, "error") for e in errors]
        options.errors, options.error_count = (Length * len(lengths))(*lengths), len(lengths)
    if levels is not None:
        options.levels = whole(levels, "levels", least=1)
    options.scale = length(scale, "scale")
    number = choice(mode, MODES, "mode")
    options.mode, options.enclose = number, choice(enclose, ENCLOSE, "enclose")
    voxels = voxelize_options(voxel, resolution, fill, up)
    scene = scene_of(scene, triangles, copy=False)
    return meshes_of(*call(Options(**run), "bp_levels", lambda r: (scene._handle.address, byref(voxels), byref(options), r), "bp_mesh_free"))


def occluder(scene, triangles=None, faces=None, scale=None, *, voxel=None, resolution=None, up=None, **run):
    """Makes a mesh strictly inside what a scene hides, for occlusion culling, as bplod --profile occluder does. Experimental.

    scene, triangles  what Scene takes
    faces    most triangles; None: chosen, some hundred
    scale    openings narrower than twice this count as closed; None: the least scale that hides nearly the most; 0: none are closed
    voxel, resolution, up  as voxelize() has them; 512 voxels by default
    run      threads, memory, temp, device, progress (Options)
    Returns a Mesh. Prove it with check(mesh, scene, inside=True). Raises InputError if the scene hides nothing.
    """
    options = OccluderOptions.made()
    options.faces = 0 if faces is None else face_count(faces)
    options.scale = length(scale, "scale")
    options.no_scale = scale is not None and options.scale.value == 0
    voxels = voxelize_options(voxel, resolution, "flood", up)
    scene = scene_of(scene, triangles, copy=False)
    handle, notes = call(Options(**run), "bp_occluder", lambda r: (scene._handle.address, byref(voxels), byref(options), r), "bp_mesh_free")
    return Mesh(handle, 0, notes)


def save_levels(meshes, folder, name="scene", *, overwrite=False):
    """Writes the files of bplod: NAME_LOD0.glb and so on and NAME.glb with all levels, NAME_occluder.glb, or NAME_cage.obj and NAME_cage.glb.
    Experimental.

    meshes     the list of levels(), or the Mesh of occluder() or cage(); all meshes that were made together are written
    folder     is made if it is missing. All files appear, or none
    """
    check(lib().bp_levels_save(_one_of(meshes, "save_levels"), path_bytes(folder, "folder"), text(name, "name"), bool(overwrite)))


def level_files(meshes, name="scene"):
    """Returns the files that save_levels() writes as a dict: their bytes by their names. Experimental."""
    files = {}

    def take(file, data):
        files.setdefault(file, bytearray()).extend(data)

    address = _one_of(meshes, "level_files")
    sunk(take, lambda sink: check(lib().bp_levels_write(address, text(name, "name"), sink, None)))
    return {file: bytes(data) for file, data in files.items()}


def _one_of(meshes, function):
    """Returns the handle of what levels(), occluder() or cage() returned."""
    mesh = next(iter(meshes), None) if isinstance(meshes, (list, tuple)) else meshes
    if not isinstance(mesh, Mesh):
        raise TypeError(f"{function}() takes what levels(), occluder() or cage() returned")
    return mesh._handle.address
