#!/usr/bin/env python3
"""How long do large scenes take, before a change and after it? Runs two folders of programs in turns, and compares the bytes of what they write.
  pace.py NOW [--before BEFORE] [--rows vox,pipe] [--turns 2] [--seconds 460] [--triangles 1e8] [--fewer 1e7] [--voxels 2048] [--work FOLDER] [--table FILE]
NOW and BEFORE are builds (build/release, with tools/ and samples/), or folders with the programs themselves; a folder lib/ there is searched for
shared libraries first. Needs Python 3.8 alone. Rows begin in the order below, each with all its turns, until the seconds are over; those that found
no time are named. Prints, for each row, the least seconds of the turns, seconds of the processor (user and system), and the peak in MiB, of the
largest process of a pipe. Status 1 if the bytes differ. Needs some 20 bytes of disk for each triangle, and 5 GB for the formats.
"""
import argparse
import array
import glob
import hashlib
import json
import multiprocessing
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import time

FORMATS = ("ply", "obj", "ascii.ply", "stl", "ascii.stl", "glb")


class Programs:
    """The programs of a build, or of a folder."""

    def __init__(self, folder):
        self.folder = os.path.abspath(folder)
        self.env = dict(os.environ)
        if os.path.isdir(f"{self.folder}/lib"):
            self.env["LD_LIBRARY_PATH"] = f"{self.folder}/lib:" + self.env.get("LD_LIBRARY_PATH", "")

    def path(self, name):
        for place in ("", "tools/", "samples/", "bin/"):
            if os.access(f"{self.folder}/{place}{name}", os.X_OK):
                return f"{self.folder}/{place}{name}"
        sys.exit(f"{self.folder}: has no {name}")

    def run(self, *commands):
        """Runs a pipe of commands. Returns seconds of the clock, of the processor, and the largest peak in MiB."""
        begin, processes, last = time.monotonic(), [], None
        for i, (name, *args) in enumerate(commands):
            out = subprocess.PIPE if i + 1 < len(commands) else None
            quiet = ["-q"] if name != "bp-plant" else []
            process = subprocess.Popen([self.path(name), *map(str, args), *quiet], stdin=last, stdout=out, env=self.env)
            if last:
                last.close()
            last = process.stdout
            processes.append(process)
        processor = peak = 0
        for process in processes:
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = status
            if status != 0:
                sys.exit(f"failed with {status}: {' '.join(process.args)}")
            processor += used.ru_utime + used.ru_stime
            peak = max(peak, used.ru_maxrss / 1024)
        return time.monotonic() - begin, processor, peak


def digest(path):
    """A hash of a file, or of all files of a folder and their names."""
    total = hashlib.blake2b(digest_size=16)
    names = [path] if os.path.isfile(path) else sorted(n for n in glob.glob(f"{path}/**", recursive=True) if os.path.isfile(n))
    for name in names:
        total.update(os.path.relpath(name, path).encode())
        with open(name, "rb") as file:
            for block in iter(lambda: file.read(1 << 22), b""):
                total.update(block)
    return total.hexdigest()


class Mesh:
    """The vertices and triangles of a binary PLY as bp-plant writes it."""

    def __init__(self, path):
        with open(path, "rb") as file:
            head = file.read(2000)
        counts = [int(line.split()[2]) for line in head.decode("latin-1").split("\n") if line.startswith("element ")]
        self.path, (self.vertices, self.faces) = path, counts[:2]
        self.at = head.index(b"end_header\n") + len(b"end_header\n")
        assert os.path.getsize(path) == self.at + 12 * self.vertices + 13 * self.faces, "not the layout that bp-plant writes"

    def read(self, at, size):
        with open(self.path, "rb") as file:
            file.seek(at)
            return file.read(size)

    def points(self, begin, end):
        return array.array("f", self.read(self.at + 12 * begin, 12 * (end - begin)))

    def corners(self, begin, end):
        return [c for _, *c in struct.iter_unpack("<BIII", self.read(self.at + 12 * self.vertices + 13 * begin, 13 * (end - begin)))]


def text_of(job):
    """Writes a part of a text file. job: the PLY, the kind, vertices or faces, a range, the file."""
    path, kind, what, begin, end, out = job
    mesh = Mesh(path)
    with open(out, "w") as file:
        if what == "vertices":
            p, lead = mesh.points(begin, end), "v " if kind == "obj" else ""
            file.write("".join(f"{lead}{p[i]:.9g} {p[i + 1]:.9g} {p[i + 2]:.9g}\n" for i in range(0, len(p), 3)))
        elif kind == "ascii.stl":
            p = mesh.points(0, mesh.vertices)
            point = lambda v: f"      vertex {p[3 * v]:.9g} {p[3 * v + 1]:.9g} {p[3 * v + 2]:.9g}\n"
            file.write("".join(f"  facet normal 0 0 1\n    outer loop\n{point(a)}{point(b)}{point(c)}    endloop\n  endfacet\n" for a, b, c in mesh.corners(begin, end)))
        elif kind == "obj":
            file.write("".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in mesh.corners(begin, end)))
        else:
            file.write("".join(f"3 {a} {b} {c}\n" for a, b, c in mesh.corners(begin, end)))
    return out


def stl_of(job):
    path, begin, end, out = job
    mesh = Mesh(path)
    p = mesh.points(0, mesh.vertices)
    with open(out, "wb") as file:
        file.write(b"".join(bytes(12) + p[3 * a:3 * a + 3].tobytes() + p[3 * b:3 * b + 3].tobytes() + p[3 * c:3 * c + 3].tobytes() + b"\0\0"
                            for a, b, c in mesh.corners(begin, end)))
    return out


def indices_of(job):
    path, begin, end, out = job
    with open(out, "wb") as file:
        file.write(array.array("I", [v for corners in Mesh(path).corners(begin, end) for v in corners]).tobytes())
    return out


def joined(out, head, parts, tail=b""):
    with open(out, "wb") as file:
        file.write(head)
        for part in parts:
            with open(part, "rb") as piece:
                shutil.copyfileobj(piece, file, 1 << 22)
            os.remove(part)
        file.write(tail)


def write_format(ply, kind, out, pool):
    """Writes the mesh of a PLY in another format, on all cores."""
    mesh = Mesh(ply)
    ranges = lambda n: [(n * i // 64, n * (i + 1) // 64, f"{out}.{i:02}") for i in range(64)]
    of_all = lambda what, n: [(ply, kind, what, begin, end, f"{part}.{what}") for begin, end, part in ranges(n)]
    if kind == "obj":
        joined(out, b"# a plant\n", pool.map(text_of, of_all("vertices", mesh.vertices) + of_all("faces", mesh.faces), 1))
    elif kind == "ascii.ply":
        head = (f"ply\nformat ascii 1.0\nelement vertex {mesh.vertices}\nproperty float x\nproperty float y\nproperty float z\n"
                f"element face {mesh.faces}\nproperty list uchar int vertex_indices\nend_header\n")
        joined(out, head.encode(), pool.map(text_of, of_all("vertices", mesh.vertices) + of_all("faces", mesh.faces), 1))
    elif kind == "ascii.stl":
        joined(out, b"solid plant\n", pool.map(text_of, of_all("faces", mesh.faces), 1), b"endsolid plant\n")
    elif kind == "stl":
        joined(out, bytes(80) + struct.pack("<I", mesh.faces), pool.map(stl_of, [(ply, *r) for r in ranges(mesh.faces)], 1))
    elif kind == "glb":
        write_glb(mesh, out, pool.map(indices_of, [(ply, *r) for r in ranges(mesh.faces)], 1))


def write_glb(mesh, out, parts):
    p = mesh.points(0, mesh.vertices)
    sizes = 12 * mesh.vertices, 12 * mesh.faces
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "buffers": [{"byteLength": sum(sizes)}],
        "bufferViews": [{"buffer": 0, "byteLength": sizes[0]}, {"buffer": 0, "byteOffset": sizes[0], "byteLength": sizes[1]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": mesh.vertices, "min": [min(p[k::3]) for k in range(3)],
                       "max": [max(p[k::3]) for k in range(3)]},
                      {"bufferView": 1, "componentType": 5125, "type": "SCALAR", "count": 3 * mesh.faces}]}).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + sum(sizes), len(text), 0x4E4F534A) + text
    joined(out, head + struct.pack("<II", sum(sizes), 0x004E4942) + p.tobytes(), parts)


class Bench:
    """Scenes that are made when a row first needs them, and the rows."""

    def __init__(self, o, folder):
        self.o, self.folder, self.programs = o, folder, {"now": Programs(o.now)}
        if o.before:
            self.programs = {"before": Programs(o.before), **self.programs}
        self.end = time.monotonic() + o.seconds
        self.rows, self.left_out, self.differing = [], [], []
        self.temp = ("--temp", folder, "--overwrite")

    def plant(self, triangles):
        path = f"{self.folder}/plant-{triangles}.ply"
        if not os.path.exists(path):
            self.programs["now"].run(("bp-plant", "--triangles", triangles, "--seed", 7, "-o", path))
        return path

    def scene(self, kind, pool):
        ply = self.plant(self.o.fewer)
        path = f"{self.folder}/plant.{kind}"
        if kind == "ply":
            return ply
        if not os.path.exists(path):
            write_format(ply, kind, path, pool)
        return path

    def row(self, name, out, *commands):
        """Measures a pipe of commands that writes `out`, with all programs in turns."""
        least, hashes, longest = {}, {}, 0
        for turn in range(self.o.turns):
            for who, programs in self.programs.items():
                if time.monotonic() + longest > self.end:
                    break
                used = programs.run(*commands)
                longest = max(longest, used[0])
                least[who] = min(least.get(who, used), used)
                if who not in hashes:
                    hashes[who] = digest(out)
                shutil.rmtree(out) if os.path.isdir(out) else os.remove(out)
        if len(least) < len(self.programs):
            self.left_out.append(name)
            return
        same = len(set(hashes.values())) == 1
        if not same:
            self.differing.append(name)
        cells = [f"{s:.2f}, {p:.1f}, {m:.0f}" for s, p, m in least.values()]
        self.rows.append([name, *cells, ("same" if same else "DIFFER") if self.o.before else ""])
        print("| " + " | ".join(self.rows[-1]) + " |", flush=True)

    def is_over(self, name):
        if time.monotonic() < self.end:
            return False
        self.left_out.append(name)
        return True

    # The rows of large scenes. All are of the plant, 2048 voxels, and a scale of 5 voxels.
    def vox(self):
        scene, out = self.plant(self.o.triangles), f"{self.folder}/out.bpv"
        self.row("bpvox", out, ("bpvox", scene, "--resolution", self.o.voxels, "-o", out, *self.temp))
        self.row("bpvox --memory 1G", out, ("bpvox", scene, "--resolution", self.o.voxels, "--memory", "1G", "-o", out, *self.temp))

    def pipe_of(self, out, *more):
        vox = ("bpvox", self.plant(self.o.triangles), "--resolution", self.o.voxels, *self.temp, *more)
        return vox, ("bpclose", "--scale", "5vx", *self.temp, *more), ("bpmesh", "--enclose", "closing", "--faces", 20000, "-o", out, *self.temp, *more)

    def pipe(self):
        out = f"{self.folder}/out.ply"
        self.row("bpvox, bpclose, bpmesh", out, *self.pipe_of(out))
        self.row("the same, --memory 1G", out, *self.pipe_of(out, "--memory", "1G"))

    def mesh(self):
        closed, out = f"{self.folder}/closed.bpv", f"{self.folder}/out.ply"
        vox, close, mesh = self.pipe_of(out)
        self.programs["now"].run(vox, (*close, "-o", closed))
        self.row("bpmesh of the closed stream", out, (mesh[0], closed, *mesh[1:]))

    def check(self):
        proxy, out, scene = f"{self.folder}/proxy.ply", f"{self.folder}/verdict.json", self.plant(self.o.triangles)
        self.programs["now"].run(*self.pipe_of(proxy))
        for name, more in (("bpcheck", ()), ("bpcheck --memory 1G", ("--memory", "1G"))):
            self.row(name, out, ("bpcheck", scene, proxy, "--report", out, "--temp", self.folder, *more))

    def lod(self):
        out = f"{self.folder}/tiles"
        self.row("bplod --profile 3dtiles --resolution 1024", out,
                 ("bplod", self.plant(self.o.triangles), "--profile", "3dtiles", "--resolution", 1024, "-o", out, *self.temp))

    def formats(self):
        with multiprocessing.Pool() as pool:
            for kind in FORMATS:
                if self.is_over(f"bpvox, {self.o.fewer:.0e} triangles, {kind}"):
                    continue
                scene, out = self.scene(kind, pool), f"{self.folder}/out.bpv"
                for threads in (0, 2):
                    name = f"bpvox, {self.o.fewer:.0e} triangles, {kind}, {threads or 'all'} threads"
                    more = ("-j", threads) if threads else ()
                    self.row(name, out, ("bpvox", scene, "--resolution", self.o.voxels, "-o", out, *self.temp, *more))
                if kind != "ply":
                    os.remove(scene)

    def gpu(self):
        stream, out = f"{self.folder}/gpu.bpv", f"{self.folder}/out.bpv"
        self.programs["now"].run(("bpvox", self.plant(self.o.fewer), "--resolution", 4096, "-o", stream, *self.temp))
        for device in ("cpu", "cuda"):
            self.row(f"bpclose, 4096 voxels, 60 voxels, {device}", out,
                     ("bpclose", stream, "--scale", "60vx", "--device", device, "-o", out, *self.temp))


ROWS = ("vox", "pipe", "mesh", "check", "lod", "formats", "gpu")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("now")
    parser.add_argument("--before")
    parser.add_argument("--rows", default=",".join(ROWS[:-1]), help="of " + ", ".join(ROWS))
    parser.add_argument("--turns", type=int, default=2)
    parser.add_argument("--seconds", type=float, default=460)
    parser.add_argument("--triangles", type=lambda s: int(float(s)), default=10**8)
    parser.add_argument("--fewer", type=lambda s: int(float(s)), default=10**7, help="triangles of the formats, and of what the GPU closes")
    parser.add_argument("--voxels", type=int, default=2048)
    parser.add_argument("--work", help="folder for scenes and outputs; without it, a temporary one")
    parser.add_argument("--table", help="file for the table")
    o = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="bp-pace-", dir=o.work) as folder:
        bench = Bench(o, folder)
        head = ["row", *(f"{who}: s, processor s, MiB" for who in bench.programs), "bytes"]
        print("| " + " | ".join(head) + " |\n" + "|---" * len(head) + "|", flush=True)
        for name in o.rows.split(","):
            if not bench.is_over(name):
                getattr(bench, name)()
    if bench.left_out:
        print("no time for: " + "; ".join(bench.left_out))
    if o.table:
        with open(o.table, "w") as file:
            file.write("".join("| " + " | ".join(row) + " |\n" for row in [head, *bench.rows]))
    sys.exit(1 if bench.differing else 0)


if __name__ == "__main__":
    main()
