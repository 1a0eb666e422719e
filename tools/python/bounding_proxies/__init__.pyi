"""Types of the module; __init__.py and the functions themselves have the documentation."""
import os
from collections.abc import Callable, Sequence
from typing import Any, Literal, Protocol, TypedDict, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Unpack

__version__: str

_Path = str | os.PathLike[str]
_Length = float | str
_Faces = int | str | Sequence[int] | None
_Progress = Callable[[str, int, int], object] | Literal[True]
_Up = Literal["unknown", "y", "z", "x", "-x", "-y", "-z"]
_Fill = Literal["flood", "winding", "none", "inside"]
_Element = Literal["cube", "ball"]
_Layer = Literal["solid", "closing"]
_Mode = Literal["auto", "bounding", "fit", "inside"]
_Enclose = Literal["auto", "scene", "input", "closing"]
_Kind = Literal["mean_value", "green", "maximum_likelihood"]
_Answer = Literal["proven", "refuted", "undecided"]
_Format = Literal["glb", "gltf", "ply", "obj", "stl"]

class _Writer(Protocol):
    def write(self, data: bytes, /) -> Any: ...

class _Vertices(Protocol):
    @property
    def vertices(self) -> Any: ...

class _Points(Protocol):
    @property
    def points(self) -> Any: ...
    @property
    def cells(self) -> Any: ...

class _ToMesh(Protocol):
    @property
    def geometry(self) -> Any: ...
    def to_mesh(self) -> Any: ...

_Mesh = tuple[ArrayLike, ArrayLike] | _Vertices | _Points | _ToMesh

class _Run(TypedDict, total=False):
    threads: int
    memory: int | str
    temp: _Path | None
    device: str | None
    progress: _Progress | None

class _Closing(_Run, total=False):
    rules: str | dict[str, Any] | None
    element: _Element
    keep_cavities: bool

class _Meshing(_Run, total=False):
    error: _Length | None
    volume: float | None
    mode: _Mode
    enclose: _Enclose
    quads: bool

class Error(Exception): ...
class FailedError(Error, RuntimeError): ...
class ArgumentError(Error, ValueError): ...
class InputError(Error, ValueError): ...
class ResourceError(Error, MemoryError): ...
class CancelledError(Error): ...

class Options:
    def __init__(self, threads: int = 0, memory: int | str = 0, temp: _Path | None = None, device: str | None = None,
                 progress: _Progress | None = None) -> None: ...

class Scene:
    def __init__(self, scene: _Path | list[_Path] | _Mesh | ArrayLike, triangles: ArrayLike | None = None, *, up: _Up | None = None,
                 copy: bool = True, format: str | None = None) -> None: ...
    def info(self, **run: Unpack[_Run]) -> dict[str, Any]: ...

_Scene = Scene | _Path | list[_Path] | _Mesh | ArrayLike

class Grid:
    notes: list[str]
    voxel: float
    origin: NDArray[np.float64]
    min: NDArray[np.int64]
    max: NDArray[np.int64]
    bounds: NDArray[np.float64]
    has_closing: bool
    fill: _Fill
    up: _Up
    scale: float
    bricks: dict[str, int]
    voxels: dict[str, int]
    rules: dict[str, Any] | None
    def field(self, rules: str | dict[str, Any], **run: Unpack[_Run]) -> Grid: ...
    def scales(self, points: ArrayLike, **run: Unpack[_Run]) -> NDArray[np.float64]: ...
    def close(self, scale: _Length | None = None, *, rules: str | dict[str, Any] | None = None, element: _Element = "cube",
              keep_cavities: bool = False, **run: Unpack[_Run]) -> Grid: ...
    @overload
    def mesh(self, faces: int | None = None, **how: Unpack[_Meshing]) -> Mesh: ...
    @overload
    def mesh(self, faces: Sequence[int], **how: Unpack[_Meshing]) -> list[Mesh]: ...
    @overload
    def mesh(self, faces: str, **how: Unpack[_Meshing]) -> Mesh | list[Mesh]: ...
    def dense(self, layer: _Layer | None = None, min: ArrayLike | None = None, max: ArrayLike | None = None) -> NDArray[np.bool_]: ...
    def brick_coords(self, layer: _Layer = "solid") -> NDArray[np.int32]: ...
    def brick(self, coord: ArrayLike, layer: _Layer = "solid") -> NDArray[np.uint64]: ...
    def save(self, path: _Path | _Writer, *, overwrite: bool = False, **run: Unpack[_Run]) -> None: ...

class Mesh:
    vertices: NDArray[np.float64]
    triangles: NDArray[np.uint32]
    quads: NDArray[np.uint32]
    volume: float
    area: float
    error_bound: float
    enclosed: str
    stopped_by: str
    notes: list[str]
    @property
    def faces(self) -> NDArray[np.uint32]: ...
    def save(self, path: _Path | _Writer, *, overwrite: bool = False, format: _Format | None = None) -> None: ...

class Verdict:
    holds: bool
    answer: _Answer
    sound: _Answer
    placed: _Answer
    reasons: str
    touching: int
    outside: int
    volume: float
    scene_volume: float
    scene_to_proxy: float
    proxy_to_scene: float
    text: str
    json: dict[str, Any]
    notes: list[str]
    def __bool__(self) -> bool: ...

class Weights:
    def __len__(self) -> int: ...
    def apply(self, vertices: ArrayLike, out: NDArray[np.float64] | None = None, **run: Unpack[_Run]) -> NDArray[np.float64]: ...

def voxelize(scene: _Scene, triangles: ArrayLike | None = None, *, voxel: _Length | None = None, resolution: int | None = None,
             fill: _Fill = "flood", up: _Up | None = None, **run: Unpack[_Run]) -> Grid: ...
def field(grid: Grid, rules: str | dict[str, Any], **run: Unpack[_Run]) -> Grid: ...
def close(grid: Grid, scale: _Length | None = None, **how: Unpack[_Closing]) -> Grid: ...
def load_grid(path: _Path, **run: Unpack[_Run]) -> Grid: ...
@overload
def mesh(grid: Grid, faces: int | None = None, *, error: _Length | None = None, volume: float | None = None,
         mode: _Mode = "auto", enclose: _Enclose = "auto", quads: bool = False, **run: Unpack[_Run]) -> Mesh: ...
@overload
def mesh(grid: Grid, faces: Sequence[int], *, error: _Length | None = None, volume: float | None = None,
         mode: _Mode = "auto", enclose: _Enclose = "auto", quads: bool = False, **run: Unpack[_Run]) -> list[Mesh]: ...
@overload
def mesh(grid: Grid, faces: str, *, error: _Length | None = None, volume: float | None = None,
         mode: _Mode = "auto", enclose: _Enclose = "auto", quads: bool = False, **run: Unpack[_Run]) -> Mesh | list[Mesh]: ...
@overload
def proxy(scene: _Scene, triangles: ArrayLike | None = None, *, faces: Sequence[int], scale: _Length | None = None,
          voxel: _Length | None = None, resolution: int | None = None, fill: _Fill = "flood", up: _Up | None = None,
          rules: str | dict[str, Any] | None = None, element: _Element = "cube", keep_cavities: bool = False, error: _Length | None = None,
          volume: float | None = None, mode: _Mode = "auto", enclose: _Enclose = "auto", quads: bool = False,
          **run: Unpack[_Run]) -> list[Mesh]: ...
@overload
def proxy(scene: _Scene, triangles: ArrayLike | None = None, *, faces: str, scale: _Length | None = None,
          voxel: _Length | None = None, resolution: int | None = None, fill: _Fill = "flood", up: _Up | None = None,
          rules: str | dict[str, Any] | None = None, element: _Element = "cube", keep_cavities: bool = False, error: _Length | None = None,
          volume: float | None = None, mode: _Mode = "auto", enclose: _Enclose = "auto", quads: bool = False,
          **run: Unpack[_Run]) -> Mesh | list[Mesh]: ...
@overload
def proxy(scene: _Scene, triangles: ArrayLike | None = None, faces: int | None = 1000, scale: _Length | None = None, *,
          voxel: _Length | None = None, resolution: int | None = None, fill: _Fill = "flood", up: _Up | None = None,
          rules: str | dict[str, Any] | None = None, element: _Element = "cube", keep_cavities: bool = False, error: _Length | None = None,
          volume: float | None = None, mode: _Mode = "auto", enclose: _Enclose = "auto", quads: bool = False,
          **run: Unpack[_Run]) -> Mesh: ...
@overload
def proxy(scene: _Scene, triangles: ArrayLike | None, faces: Sequence[int], scale: _Length | None = None, *,
          voxel: _Length | None = None, resolution: int | None = None, fill: _Fill = "flood", up: _Up | None = None,
          rules: str | dict[str, Any] | None = None, element: _Element = "cube", keep_cavities: bool = False, error: _Length | None = None,
          volume: float | None = None, mode: _Mode = "auto", enclose: _Enclose = "auto", quads: bool = False,
          **run: Unpack[_Run]) -> list[Mesh]: ...
@overload
def proxy(scene: _Scene, triangles: ArrayLike | None, faces: str, scale: _Length | None = None, *,
          voxel: _Length | None = None, resolution: int | None = None, fill: _Fill = "flood", up: _Up | None = None,
          rules: str | dict[str, Any] | None = None, element: _Element = "cube", keep_cavities: bool = False, error: _Length | None = None,
          volume: float | None = None, mode: _Mode = "auto", enclose: _Enclose = "auto", quads: bool = False,
          **run: Unpack[_Run]) -> Mesh | list[Mesh]: ...
def load(path: _Path, **run: Unpack[_Run]) -> list[Mesh]: ...
def hulls(mesh: Mesh, hulls: int = 0, *, faces: int = 0, corners: int = 0, **run: Unpack[_Run]) -> list[Mesh]: ...
def check(proxy: _Path | _Mesh | Mesh, scene: _Scene | None = None, *, inside: bool = False, convex: bool = False,
          margin: _Length | None = None, distances: bool = True, **run: Unpack[_Run]) -> Verdict: ...
def levels(scene: _Scene, triangles: ArrayLike | None = None, faces: _Faces = None, *,
           error: _Length | Sequence[_Length] | None = None, levels: int | None = None, scale: _Length | None = None,
           mode: Literal["auto", "bounding", "fit"] = "bounding", enclose: _Enclose = "auto", voxel: _Length | None = None,
           resolution: int | None = None, fill: Literal["flood", "winding", "none"] = "flood", up: _Up | None = None,
           **run: Unpack[_Run]) -> list[Mesh]: ...
def occluder(scene: _Scene, triangles: ArrayLike | None = None, faces: int | None = None, scale: _Length | None = None, *,
             voxel: _Length | None = None, resolution: int | None = None, up: _Up | None = None, **run: Unpack[_Run]) -> Mesh: ...
def save_levels(meshes: list[Mesh] | Mesh, folder: _Path, name: str = "scene", *, overwrite: bool = False) -> None: ...
def level_files(meshes: list[Mesh] | Mesh, name: str = "scene") -> dict[str, bytes]: ...
def cage(scene: Grid | _Scene, triangles: ArrayLike | int | None = None, faces: int | None = None, *, margin: _Length | None = None,
         symmetry: Literal["auto", "off", "x", "y", "z"] = "auto", voxel: _Length | None = None, resolution: int | None = None,
         fill: Literal["flood", "winding", "none"] = "flood", up: _Up | None = None, **run: Unpack[_Run]) -> Mesh: ...
def bind(cage: _Mesh | Mesh, points: ArrayLike, kind: _Kind = "mean_value", *, carry_outside: bool = False,
         **run: Unpack[_Run]) -> Weights: ...
def library_version() -> str: ...
