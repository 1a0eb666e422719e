"""libbp.so by ctypes: its structs as bp/bp.h has them, its functions, and its errors as exceptions."""
import ctypes
import math
import operator
import os
import re
from ctypes import POINTER, Structure, byref, c_char_p, c_double, c_int, c_int32, c_int64, c_size_t, c_uint32, c_uint64, c_void_p, sizeof
from pathlib import Path

Progress = ctypes.CFUNCTYPE(c_int, c_void_p, c_char_p, c_char_p, c_uint64, c_uint64)
Note = ctypes.CFUNCTYPE(None, c_void_p, c_char_p)
Sink = ctypes.CFUNCTYPE(c_int, c_void_p, c_char_p, c_void_p, c_size_t)


class Length(Structure):
    _fields_ = [("value", c_double), ("unit", c_int32)]


class Sized(Structure):
    """A struct that begins with its size; the library fills in the defaults."""

    defaults = ""

    @classmethod
    def made(cls):
        value = cls(size=sizeof(cls))
        if cls.defaults:
            getattr(lib(), cls.defaults)(byref(value), sizeof(cls))
        return value


class Run(Sized):
    defaults = "bp_run_defaults"
    _fields_ = [("size", c_size_t), ("threads", c_int32), ("memory", c_uint64), ("temp", c_char_p), ("device", c_char_p), ("progress", Progress),
                ("note", Note), ("user", c_void_p), ("stop", c_void_p)]


class Arrays(Sized):
    defaults = "bp_arrays_defaults"
    _fields_ = [("size", c_size_t), ("vertices", c_void_p), ("vertex_count", c_size_t), ("vertex_stride", c_size_t), ("vertex_type", c_int32),
                ("triangles", c_void_p), ("triangle_count", c_size_t), ("triangle_stride", c_size_t), ("triangle_type", c_int32),
                ("borrow", c_int32), ("up", c_int32)]


class SceneInfo(Sized):
    _fields_ = [("size", c_size_t), ("triangles", c_uint64), ("degenerate", c_uint64), ("non_finite", c_uint64), ("bad_faces", c_uint64),
                ("min", c_double * 3), ("max", c_double * 3)]


class VoxelizeOptions(Sized):
    defaults = "bp_voxelize_defaults"
    _fields_ = [("size", c_size_t), ("voxel", Length), ("resolution", c_int64), ("fill", c_int32), ("up", c_int32)]


class CloseOptions(Sized):
    defaults = "bp_close_defaults"
    _fields_ = [("size", c_size_t), ("scale", Length), ("rules", c_char_p), ("element", c_int32), ("keep_cavities", c_int32), ("no_scale", c_int32)]


class GridInfo(Sized):
    _fields_ = [("size", c_size_t), ("voxel", c_double), ("origin", c_double * 3), ("min", c_int32 * 3), ("max", c_int32 * 3),
                ("bounds_min", c_double * 3), ("bounds_max", c_double * 3), ("has_closing", c_int32), ("fill", c_int32), ("up", c_int32),
                ("scale", c_double), ("bricks", c_uint64 * 2), ("voxels", c_uint64 * 2), ("rules", c_char_p)]


class MeshOptions(Sized):
    defaults = "bp_mesh_defaults"
    _fields_ = [("size", c_size_t), ("faces", POINTER(c_uint64)), ("levels", c_size_t), ("error", Length), ("volume", c_double), ("mode", c_int32),
                ("enclose", c_int32), ("quads", c_int32)]


class MeshView(Sized):
    _fields_ = [("size", c_size_t), ("vertices", c_void_p), ("vertex_count", c_size_t), ("triangles", c_void_p), ("triangle_count", c_size_t),
                ("quads", c_void_p), ("quad_count", c_size_t)]


class MeshInfo(Sized):
    _fields_ = [("size", c_size_t), ("volume", c_double), ("area", c_double), ("faces_asked", c_uint64), ("error_bound", c_double),
                ("stopped_by", c_char_p), ("enclosed", c_char_p)]


class CheckOptions(Sized):
    defaults = "bp_check_defaults"
    _fields_ = [("size", c_size_t), ("inside", c_int32), ("convex", c_int32), ("margin", Length), ("no_distances", c_int32)]


class VerdictInfo(Sized):
    _fields_ = [("size", c_size_t), ("answer", c_int32), ("sound", c_int32), ("placed", c_int32), ("touching", c_uint64), ("outside", c_uint64),
                ("volume", c_double), ("scene_volume", c_double), ("scene_to_proxy", c_double), ("proxy_to_scene", c_double)]


class HullsOptions(Sized):
    defaults = "bp_hulls_defaults"
    _fields_ = [("size", c_size_t), ("hulls", c_uint32), ("faces", c_uint64), ("corners", c_uint32)]


class LevelsOptions(Sized):
    defaults = "bp_levels_defaults"
    _fields_ = [("size", c_size_t), ("faces", POINTER(c_uint64)), ("face_count", c_size_t), ("errors", POINTER(Length)), ("error_count", c_size_t),
                ("levels", c_uint32), ("scale", Length), ("mode", c_int32), ("enclose", c_int32)]


class OccluderOptions(Sized):
    defaults = "bp_occluder_defaults"
    _fields_ = [("size", c_size_t), ("faces", c_uint64), ("scale", Length), ("no_scale", c_int32)]


class CageOptions(Sized):
    defaults = "bp_cage_defaults"
    _fields_ = [("size", c_size_t), ("faces", c_uint64), ("margin", Length), ("no_margin", c_int32), ("symmetry", c_int32)]


class BindOptions(Sized):
    defaults = "bp_bind_defaults"
    _fields_ = [("size", c_size_t), ("kind", c_int32), ("carry_outside", c_int32)]


class Error(Exception):
    """A call of the library failed. Its text tells the object, the fact and, as a rule, a remedy."""


class FailedError(Error, RuntimeError):
    """The work could not be done, for a reason that is none of the others."""


class ArgumentError(Error, ValueError):
    """The call asks for something impossible."""


class InputError(Error, ValueError):
    """A scene or a file is missing, broken or of the wrong kind."""


class ResourceError(Error, MemoryError):
    """Memory, disk or device is exhausted or absent."""


class CancelledError(Error):
    """The progress callback returned True."""


ERRORS = {1: FailedError, 2: ArgumentError, 3: InputError, 4: ResourceError, 5: CancelledError}

_p, _s, _i = c_void_p, c_size_t, c_int
_FUNCTIONS = {  # name: result, arguments
    "bp_version": (c_char_p, []),
    "bp_error_message": (c_char_p, []),
    "bp_stop_new": (_p, []),
    "bp_stop_set": (None, [_p]),
    "bp_stop_free": (None, [_p]),
    "bp_length_parse": (_i, [c_char_p, _p]),
    "bp_scene_from_arrays": (_i, [_p, c_char_p, _p]),
    "bp_scene_from_files": (_i, [_p, _s, c_char_p, _p]),
    "bp_scene_read_info": (_i, [_p, _p, _p, _s]),
    "bp_scene_free": (None, [_p]),
    "bp_voxelize": (_i, [_p, _p, _p, _p]),
    "bp_field": (_i, [_p, c_char_p, _p, _p]),
    "bp_close": (_i, [_p, _p, _p, _p]),
    "bp_grid_load": (_i, [c_char_p, _p, _p]),
    "bp_grid_save": (_i, [_p, c_char_p, _i, _p]),
    "bp_grid_write": (_i, [_p, Sink, _p, _p]),
    "bp_grid_read_info": (_i, [_p, _p, _s]),
    "bp_grid_scales": (_i, [_p, _p, _s, _p, _p]),
    "bp_grid_read": (_i, [_p, _i, _p, _p, _p]),
    "bp_grid_bricks": (_i, [_p, _i, _p, _s, _p]),
    "bp_grid_brick": (_i, [_p, _i, _p, _p]),
    "bp_grid_free": (None, [_p]),
    "bp_mesh_make": (_i, [_p, _p, _p, _p]),
    "bp_proxy": (_i, [_p, _p, _p, _p, _p, _p]),
    "bp_mesh_load": (_i, [c_char_p, _p, _p]),
    "bp_mesh_count": (_s, [_p]),
    "bp_mesh_look": (_i, [_p, _s, _p, _s]),
    "bp_mesh_read_info": (_i, [_p, _s, _p, _s]),
    "bp_mesh_save": (_i, [_p, _s, c_char_p, _i]),
    "bp_mesh_write": (_i, [_p, _s, c_char_p, Sink, _p]),
    "bp_mesh_free": (None, [_p]),
    "bp_check": (_i, [_p, _p, _p, _p, _p]),
    "bp_check_mesh": (_i, [_p, _s, _p, _p, _p, _p]),
    "bp_verdict_read_info": (_i, [_p, _p, _s]),
    "bp_verdict_reasons": (c_char_p, [_p]),
    "bp_verdict_text": (c_char_p, [_p]),
    "bp_verdict_json": (c_char_p, [_p]),
    "bp_verdict_free": (None, [_p]),
    "bp_hulls": (_i, [_p, _s, _p, _p, _p]),
    "bp_levels": (_i, [_p, _p, _p, _p, _p]),
    "bp_occluder": (_i, [_p, _p, _p, _p, _p]),
    "bp_scene_cage": (_i, [_p, _p, _p, _p, _p]),
    "bp_levels_save": (_i, [_p, c_char_p, c_char_p, _i]),
    "bp_levels_write": (_i, [_p, c_char_p, Sink, _p]),
    "bp_cage": (_i, [_p, c_uint64, _p, _p]),
    "bp_bind": (_i, [_p, _p, _s, _p, _p, _p]),
    "bp_weights_apply": (_i, [_p, _p, _p, _p]),
    "bp_weights_count": (_s, [_p]),
    "bp_weights_free": (None, [_p]),
}
for _struct in Sized.__subclasses__():
    if _struct.defaults:
        _FUNCTIONS[_struct.defaults] = (None, [_p, _s])

_loaded = None


def _open():
    named = os.environ.get("BP_LIBRARY")
    here = Path(__file__).resolve().parent
    # Beside the module, in the prefix of lib/python3/dist-packages, or where the system looks for libraries.
    places = [here / "libbp.so.0", *here.parents[min(2, len(here.parents) - 1)].glob("libbp.so.0")]
    names = [named] if named else [*(str(p) for p in places if p.exists()), "libbp.so.0"]
    try:
        return ctypes.CDLL(names[0])
    except OSError as e:
        raise ImportError(f"bounding_proxies needs {names[0]}, the C library of the suite: {e}. Install the package libbp0, or name the file "
                          "with BP_LIBRARY") from None


def lib():
    """Returns the library, which is loaded when it is first needed."""
    global _loaded
    if _loaded is None:
        opened = _open()
        for name, (result, arguments) in _FUNCTIONS.items():
            try:
                function = getattr(opened, name)
            except AttributeError:
                raise ImportError(f"bounding_proxies: {opened._name} has no {name}(): it is older than this module. Install both of one version") from None
            function.restype, function.argtypes = result, arguments
        _loaded = opened
    return _loaded


def check(status):
    """Raises the error of a call that failed on this thread."""
    if status != 0:
        raise ERRORS.get(status, FailedError)(lib().bp_error_message().decode(errors="replace"))


def write_all(file, data):
    """Writes all bytes: a raw file or a pipe may take fewer at a time, and tells how many."""
    rest = memoryview(data)
    while len(rest) > 0:
        taken = file.write(rest)
        rest = rest[taken if isinstance(taken, int) else len(rest):]


def sunk(take, function):
    """Calls function(sink), which gives a sink to the library. take(name, bytes) gets the bytes; an error of it ends the call, and is raised."""
    errors = []

    def sink(_, name, address, count):
        try:
            take(name and name.decode(), ctypes.string_at(address, count))
        except BaseException as e:
            errors.append(e)
        return len(errors)
    try:
        function(Sink(sink))
    except CancelledError:
        if errors:
            raise errors[0] from None
        raise


class Unchanging:
    """An object of the library, which does not change: its copy is the object itself, and other processes cannot have it."""

    def __copy__(self):
        return self

    def __deepcopy__(self, memo):
        return self

    def __reduce__(self):
        raise TypeError(f"a {type(self).__name__} of bounding_proxies cannot be pickled: it is an object of the C library. Hand on its arrays, "
                        "or a file")


class Handle(Unchanging):
    """The address of an object of the library, which is freed with this one."""

    def __init__(self, address, free):
        self.address, self._free = address, free

    def __del__(self):
        if self.address and _loaded is not None:
            getattr(_loaded, self._free)(self.address)
        self.address = None


def text(value, name):
    """Returns a text as the bytes of a string of C."""
    if not isinstance(value, str):
        raise ArgumentError(f"{name}: {value!r} is no text")
    if "\0" in value:
        raise ArgumentError(f"{name}: {value!r} has a character of number 0")
    return value.encode(errors="surrogateescape")


def counted(number, one):
    """Returns "1 triangle", "2 triangles"."""
    return f"{number} {one}{'s' * (number != 1)}"


def path_bytes(path, name):
    """Returns the name of a file or a folder as a string of C."""
    return text(os.fsdecode(path), name)


def needed(value, kind, made_by):
    """Refuses what is no object of a class. made_by: the functions that return them."""
    if not isinstance(value, kind):
        raise TypeError(f"{type(value).__name__} is no {kind.__name__}; give what {made_by} returned")
    return value


def length(value, name):
    """Returns a Length of a number in scene units, or of a text: "2%", "20vx", "0.5"."""
    out = Length()
    if value is None:
        return out
    if isinstance(value, str):
        check(lib().bp_length_parse(text(value, name), byref(out)))
        return out
    try:
        out.value = float(value)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name}: {value!r} is no length; give a number in scene units, or a text such as '2%'") from None
    return out


def factor(value, name):
    """Returns a number as a float."""
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise ArgumentError(f"{name}: {value!r} is no number; write it without quotes, as {name}=1.5") from None


def whole(value, name, least=0, below=2**31):
    """Returns a whole number, from `least` on and smaller than `below`."""
    try:
        if isinstance(value, bool):
            raise TypeError
        number = operator.index(value) if not isinstance(value, float) or not value.is_integer() else int(value)
    except TypeError:
        raise ArgumentError(f"{name}: {value!r} is no whole number; write it without quotes, as {name}={max(least, 8)}") from None
    if not least <= number < below:
        raise ArgumentError(f"{name}: {value!r} is no number from {least} to {below - 1}")
    return number


def size(value, name):
    """Returns a number of bytes, of a number or of a text as the tools take it: "64M", "4GiB"."""
    if not isinstance(value, str):
        return whole(value, name, below=2**62)
    match = re.fullmatch(r"([0-9]*\.?[0-9]+)(?:([KMGT])(?:i?B)?|B)?", value)
    if not match:
        raise ArgumentError(f"{name}: {value!r} is no size; write a number of bytes, or a text such as '512M' or '4G'")
    return whole(math.floor(float(match[1]) * 1024 ** " KMGT".index(match[2] or " ")), name, below=2**62)


def choice(value, names, name):
    """Returns the number of a word."""
    word = value
    if isinstance(value, str) and value not in names:
        word = value.replace("-", "_")  # as the tools write words
    if word not in names:
        raise ArgumentError(f"{name}: {value!r} is none of {', '.join(map(str, names))}")
    return names.index(word)


def read_struct(cls, function, *arguments):
    """Returns a struct that a function of the library fills in."""
    out = cls()
    check(getattr(lib(), function)(*arguments, byref(out), sizeof(cls)))
    return out
