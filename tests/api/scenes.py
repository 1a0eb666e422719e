"""Scenes for the tests of the Python module, and the tools to compare with."""
import subprocess
import sys
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("SKIPPED: NumPy is not installed (python3-numpy)")
    sys.exit(77)


def grid_mesh(places, closed_u, closed_v):
    """Triangles over an array of places (u, v, 3)."""
    nu, nv = places.shape[:2]
    number = np.arange(nu * nv).reshape(nu, nv)
    a, b = number, np.roll(number, -1, 0)
    c, d = np.roll(b, -1, 1), np.roll(a, -1, 1)
    if not closed_u:
        a, b, c, d = a[:-1], b[:-1], c[:-1], d[:-1]
    if not closed_v:
        a, b, c, d = a[:, :-1], b[:, :-1], c[:, :-1], d[:, :-1]
    return places.reshape(-1, 3).copy(), np.stack([a, b, c, a, c, d], -1).reshape(-1, 3).astype(np.uint32)


def torus(nu=40, nv=20, big=2.0, small=0.7):
    u, v = np.meshgrid(np.arange(nu) * 2 * np.pi / nu, np.arange(nv) * 2 * np.pi / nv, indexing="ij")
    ring = big + small * np.cos(v)
    return grid_mesh(np.stack([ring * np.cos(u), ring * np.sin(u), small * np.sin(v)], -1), True, True)


def bowl(n=30):
    """An open surface."""
    u, v = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.linspace(0.05, 1, n), indexing="ij")
    return grid_mesh(np.stack([v * np.cos(u), v * np.sin(u), v * v + 0.1 * np.sin(3 * u) * v], -1), True, False)


def soup(n=250, seed=1):
    """Triangles that have nothing to do with each other."""
    random = np.random.default_rng(seed)
    centres = random.uniform(-1, 1, (n, 1, 3)) * [3, 1, 2]
    return (centres + random.normal(0, 0.15, (n, 3, 3))).reshape(-1, 3), np.arange(3 * n, dtype=np.uint32).reshape(n, 3)


def far_boxes():
    """Boxes with gaps, far from the origin, in single precision."""
    corners = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)], float)
    faces = np.array([0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5]).reshape(-1, 3)
    vertices = np.concatenate([corners * [4, 4, 9] + [5 * i + 1000, 0, 3 * (i % 3)] for i in range(5)])
    return vertices.astype(np.float32), np.concatenate([faces + 8 * i for i in range(5)]).astype(np.int64)


SCENES = {"torus": torus, "bowl": bowl, "soup": soup, "far boxes": far_boxes}


def write_ply(path, vertices, triangles):
    """Binary PLY with doubles."""
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
    head += f"element face {len(triangles)}\nproperty list uchar uint vertex_indices\nend_header\n"
    rows = np.empty(len(triangles), np.dtype([("n", "u1"), ("v", "<u4", 3)]))
    rows["n"], rows["v"] = 3, triangles
    Path(path).write_bytes(head.encode() + np.asarray(vertices, "<f8").tobytes() + rows.tobytes())


def read_ply(path):
    """Vertices and triangles of a PLY of the tools that has no quads."""
    head, rest = Path(path).read_bytes().split(b"end_header\n", 1)
    words = head.decode().split("\n")
    vertices = next(int(w.split()[2]) for w in words if w.startswith("element vertex"))
    faces = next(int(w.split()[2]) for w in words if w.startswith("element face"))
    numbers = np.frombuffer(rest, "<f8", 3 * vertices).reshape(-1, 3)
    rows = np.frombuffer(rest, np.dtype([("n", "u1"), ("v", "<u4", 3)]), faces, 24 * vertices)
    return numbers, rows["v"]


def tool(*arguments, stdin=None, status=0):
    """Runs a tool quietly; returns what it prints."""
    run = subprocess.run([str(a) for a in arguments], input=stdin, capture_output=True, check=False)
    if run.returncode != status:
        raise AssertionError(f"{arguments}: status {run.returncode}: {run.stderr.decode()}")
    return run.stdout


def pipe(scene, out, vox=(), close=(), mesh=()):
    """bpvox | bpclose | bpmesh."""
    voxels = tool("bpvox", scene, *vox)
    closed = tool("bpclose", *close, stdin=voxels) if close is not None else voxels
    tool("bpmesh", *mesh, "-o", out, "--overwrite", stdin=closed)
    return Path(out).read_bytes()
