"""Bounding proxies of triangle scenes, after Calderon and Boubekeur, "Bounding Proxies for Shape Approximation", SIGGRAPH 2017.

    import bounding_proxies as bp
    proxy = bp.proxy(vertices, triangles, faces=1000, scale="1%")   # or bp.proxy("scene.glb"), bp.proxy(trimesh_object)
    proxy.vertices, proxy.triangles                                 # NumPy arrays, in scene units
    assert bp.check(proxy, (vertices, triangles))                   # proven: closed, embedded, around every triangle
    proxy.save("proxy.glb")

A proxy is a coarse closed mesh that strictly encloses a scene, which may be a soup of triangles with gaps. The same scene and arguments give
the same bytes, on any number of threads, and those of the tools bpvox, bpclose and bpmesh. Calls free the GIL, may run at once on several
threads, and end early by Ctrl-C.
"""
from ._cage import Weights, bind, cage
from ._call import Options
from ._check import Verdict, check
from ._grid import Grid, close, field, load_grid, voxelize
from ._library import ArgumentError, CancelledError, Error, FailedError, InputError, ResourceError, lib
from ._levels import level_files, levels, occluder, save_levels
from ._mesh import Mesh, hulls, load, mesh, proxy
from ._scene import Scene

__all__ = ["ArgumentError", "CancelledError", "Error", "FailedError", "Grid", "InputError", "Mesh", "Options", "ResourceError", "Scene", "Verdict",
           "Weights", "bind", "cage", "check", "close", "field", "hulls", "level_files", "levels", "library_version", "load", "load_grid", "mesh",
           "occluder", "proxy", "save_levels", "voxelize"]


def __getattr__(name):
    if name == "__version__":
        return library_version()
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def library_version():
    """Returns the version of the C library, such as "0.3.0"."""
    return lib().bp_version().decode()
