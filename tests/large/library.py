#!/usr/bin/env python3
"""Runs all functions of the Python module over models, and compares each with the bytes of the tools.
    PYTHONPATH=tools/python BP_LIBRARY=build/tools/api/libbp.so.0 PATH=build/tools:$PATH tests/large/library.py MODELS [MOST [MOST_BYTES]]
MODELS: a folder of models, of which the MOST smallest (40) that the tools read are taken. Prints a line for each model, and what differs. Needs NumPy."""
import io
import json
import shutil
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "api"))
from scenes import np, pipe, tool, write_ply  # noqa: E402

import bounding_proxies as bp  # noqa: E402

ENDINGS = {".ply", ".stl", ".obj", ".off", ".glb", ".gltf", ".dae", ".ac", ".3ds", ".fbx", ".acc"}
EXACT = {".ply", ".stl", ".obj", ".off"}
RESOLUTION = 64
GRID = ["--resolution", RESOLUTION]


class Model:
    """The comparisons of one model."""

    def __init__(self, path, home):
        self.path, self.home, self.same, self.differ, self.left = path, home, [], [], []
        self.arrays = None

    def compare(self, what, mine, wanted):
        (self.same if mine == wanted else self.differ).append(what)

    def bytes_of(self, mesh, ending):
        mesh.save(self.home / f"mine.{ending}", overwrite=True)
        return (self.home / f"mine.{ending}").read_bytes()

    def read_arrays(self):
        """Takes the triangles as arrays; none where the file holds several meshes, drops triangles, or is read with rounding, which a proxy
        of the file keeps clear of."""
        try:
            loaded = bp.load(self.path)
        except bp.Error as e:
            self.left.append(f"load: {e}")
            return
        info = bp.Scene(self.path).info()
        whole = self.path.suffix.lower() in EXACT and info["degenerate"] + info["non_finite"] + info["bad_faces"] == 0 and len(loaded) == 1
        if whole and len(loaded[0].triangles) == info["triangles"]:
            self.arrays = loaded[0].vertices, loaded[0].triangles

    def pipe(self):
        streams = [tool("bpvox", self.path, *GRID)]
        streams.append(tool("bpclose", "--scale", "2%", stdin=streams[0]))
        grid = bp.voxelize(self.path, resolution=RESOLUTION)
        closed = grid.close("2%")
        for name, one, wanted in (("voxelize", grid, streams[0]), ("close", closed, streams[1])):
            one.save(self.home / "mine.bpv", overwrite=True)
            self.compare(name, (self.home / "mine.bpv").read_bytes(), wanted)
        self.compare("load_grid", self.bytes_of(bp.load_grid(self.home / "mine.bpv").mesh(100), "glb"), self.bytes_of(closed.mesh(100), "glb"))
        tool("bpmesh", "--faces", "300,100", "-o", self.home / "t.glb", "--overwrite", stdin=streams[1])
        for i, level in enumerate(closed.mesh([300, 100])):
            self.compare(f"mesh {i}", self.bytes_of(level, "glb"), (self.home / f"t.{i}.glb").read_bytes())
        for ending in ("ply", "obj", "glb"):
            wanted = pipe(self.path, self.home / f"t.{ending}", GRID, ["--scale", "2%"], ["--faces", "200"])
            proxy = bp.proxy(self.path, faces=200, scale="2%", resolution=RESOLUTION)
            self.compare(f"proxy {ending}", self.bytes_of(proxy, ending), wanted)
        if self.arrays:
            self.compare("proxy of arrays", self.bytes_of(bp.proxy(*self.arrays, faces=200, scale="2%", resolution=RESOLUTION), "glb"), wanted)
        return proxy

    def field(self):
        rules = self.home / "rules.json"
        rules.write_text('{"base": "3%", "orientation": "auto", "rules": [{"gap": "4%"}]}')
        grid = bp.voxelize(self.path, resolution=RESOLUTION)
        voxels = tool("bpvox", self.path, *GRID)
        try:
            wanted = tool("bpscale", rules, stdin=voxels)
        except AssertionError as e:
            try:
                grid.field(rules.read_text())
            except bp.Error as f:
                self.compare("field: refused", str(f).rsplit(":", 1)[-1] in str(e), True)
            return
        sink = io.BytesIO()
        grid.field(rules.read_text()).save(sink)
        self.compare("field", sink.getvalue(), wanted)

    def bplod(self, profile, make, how, options):
        theirs, mine = self.home / "theirs", self.home / "mine"
        options = [*options, *GRID, *(["--appearance", "off"] if profile == "levels" else ["--profile", profile])]
        try:
            tool("bplod", self.path, "-o", theirs, "--name", "n", *options)
        except AssertionError as e:
            try:
                make(self.path, resolution=RESOLUTION, **how)
            except bp.Error as f:
                self.compare(f"{profile}: refused", str(f).split(":")[0] in str(e), True)
            return
        wanted = {f.name: f.read_bytes() for f in theirs.iterdir()}
        for name, scene in (("", (self.path,)), (" of arrays", self.arrays)):
            if scene is None:
                continue
            made = make(*scene, resolution=RESOLUTION, **how)
            bp.save_levels(made, mine, "n")
            self.compare(profile + name, {f.name: f.read_bytes() for f in mine.iterdir()}, wanted)
            self.compare(f"{profile}{name} in memory", bp.level_files(made, "n"), wanted)
            shutil.rmtree(mine)
        shutil.rmtree(theirs)

    def proofs(self, proxy):
        verdict = bp.check(proxy, self.path)
        status = {"proven": 0, "refuted": 1, "undecided": 5}[verdict.answer]
        told = json.loads(tool("bpcheck", "--json", self.path, self.home / "t.ply", status=status))
        for one in (told, verdict.json):
            del one["proxy"]["name"]  # a file's, and "the proxy"
        self.compare("check", verdict.json, told)
        hulls = bp.hulls(proxy, 8)
        first = np.cumsum([0] + [len(h.vertices) for h in hulls])
        all_hulls = np.concatenate([h.vertices for h in hulls]), np.concatenate([h.triangles.astype(int) + n for h, n in zip(hulls, first)])
        self.compare("hulls", bp.check(all_hulls, self.path, convex=True, distances=False).answer, verdict.answer)

    def points(self, proxy):
        order = np.unique(proxy.triangles.ravel(), return_index=True)[1].argsort()  # files number vertices by their first use
        number = np.empty(len(order), int)
        number[order] = np.arange(len(order))
        cage, faces = proxy.vertices[order], number[proxy.triangles]
        moved = cage + 0.05 * np.linalg.norm(np.ptp(cage, 0)) * np.sin(np.arange(cage.size).reshape(cage.shape))
        points = (cage.min(0) + cage.max(0)) / 2 + np.zeros((40, 3))
        points += np.random.default_rng(1).normal(0, 0.02, points.shape) * np.ptp(cage, 0)
        write_ply(self.home / "cage.ply", cage, faces)
        write_ply(self.home / "moved.ply", moved, faces)
        write_ply(self.home / "points.ply", points, np.arange(39, dtype=np.uint32).reshape(13, 3))
        tool("bpdeform", "bind", self.home / "points.ply", self.home / "cage.ply", "--outside", "near", "-o", self.home / "w.bpw", "--overwrite")
        tool("bpdeform", "apply", self.home / "w.bpw", self.home / "moved.ply", "-o", self.home / "out.ply", "--overwrite")
        wanted = np.frombuffer((self.home / "out.ply").read_bytes().split(b"end_header\n", 1)[1], "<f8", 3 * 40).reshape(-1, 3)
        self.compare("bind and apply", bool(np.array_equal(bp.bind((cage, faces), points, carry_outside=True).apply(moved), wanted)), True)

    def run(self):
        self.read_arrays()
        proxy = self.pipe()
        self.field()
        self.bplod("levels", bp.levels, dict(faces=[300, 80]), ["--faces", "300,80"])
        self.bplod("occluder", bp.occluder, dict(faces=80), ["--faces", "80"])
        self.bplod("cage", bp.cage, dict(faces=200, margin="1%"), ["--faces", "200", "--margin", "1%"])
        self.proofs(proxy)
        self.points(proxy)


def main():
    most = int(sys.argv[2]) if len(sys.argv) > 2 else 40
    limit = int(sys.argv[3]) if len(sys.argv) > 3 else 1 << 40
    files = [f for f in Path(sys.argv[1]).iterdir() if f.suffix.lower() in ENDINGS and f.stat().st_size <= limit]
    files.sort(key=lambda f: (f.stat().st_size, f.name))
    models = compared = wrong = arrays = 0
    for path in files:
        if models == most:
            break
        with tempfile.TemporaryDirectory() as folder:
            model, begin = Model(path, Path(folder)), time.monotonic()
            try:
                model.run()
            except (AssertionError, bp.Error) as e:
                if not model.same:
                    print(f"{path.name}: not read: {str(e).splitlines()[-1][-150:]}", flush=True)
                    continue
                model.differ.append(f"failed: {str(e)[-300:]}")
        models, compared, wrong = models + 1, compared + len(model.same) + len(model.differ), wrong + len(model.differ)
        arrays += model.arrays is not None
        print(f"{path.name}: {len(model.same)} the same{', arrays, too' if model.arrays else ''}; {time.monotonic() - begin:.1f} s", *model.differ,
              sep="\n  DIFFERS: ", flush=True)
    print(f"{models} models, {arrays} of them also as arrays: {compared} comparisons, {wrong} differ")
    return 1 if wrong or models < most else 0


if __name__ == "__main__":
    sys.exit(main())
