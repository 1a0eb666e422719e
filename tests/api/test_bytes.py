#!/usr/bin/env python3
"""The Python module gives the bytes of the tools."""
import io
import json
import os
import shutil
import tempfile
import unittest
from pathlib import Path

from scenes import SCENES, np, pipe, read_ply, tool, torus, write_ply

import bounding_proxies as bp

# Arguments of proxy(), and the options of the tools that say the same.
CASES = {
    "defaults": (dict(faces=None, resolution=64), ["--resolution", "64"], [], []),
    "scale in percent": (dict(faces=300, scale="3%", resolution=96), ["--resolution", "96"], ["--scale", "3%"], ["--faces", "300"]),
    "ball, coarse": (dict(faces=200, scale="4%", element="ball", resolution=64), ["--resolution", "64"], ["--scale", "4%", "--element", "ball"],
                     ["--faces", "200"]),
    "voxels, no filling": (dict(faces=500, scale="6vx", voxel="2%", fill="none"), ["--voxel", "2%", "--fill", "none"], ["--scale", "6vx"],
                           ["--faces", "500"]),
    "error": (dict(faces=None, scale="2%", error="2%", resolution=24), ["--resolution", "24"], ["--scale", "2%"], ["--error", "2%"]),
    "fit": (dict(faces=400, scale="2%", mode="fit", resolution=64), ["--resolution", "64"], ["--scale", "2%"], ["--faces", "400", "--mode", "fit"]),
    "of its voxels": (dict(faces=300, scale="2%", enclose="input", resolution=96, up="z"), ["--resolution", "96", "--up", "z"], ["--scale", "2%"],
                      ["--faces", "300", "--enclose", "input"]),
}


class Bytes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.home = Path(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def scene_file(self, name):
        path = self.home / f"{name.replace(' ', '_')}.ply"
        vertices, triangles = SCENES[name]()
        if not path.exists():
            write_ply(path, vertices, triangles)
        return path, vertices, triangles

    def saved(self, mesh, ending="glb"):
        path = self.home / f"mine.{ending}"
        mesh.save(path, overwrite=True)
        return path.read_bytes()

    def test_a_proxy_of_arrays_and_of_a_file_has_the_bytes_of_the_tools(self):
        for k, scene in enumerate(SCENES):
            path, vertices, triangles = self.scene_file(scene)
            for i, (case, (how, vox, close, mesh)) in enumerate(CASES.items()):
                if (i + k) % 4 > 0 and os.environ.get("BP_ALL") is None:
                    continue  # a quarter of them; BP_ALL=1: all
                with self.subTest(scene=scene, case=case):
                    wanted = pipe(path, self.home / "tools.glb", vox, close, mesh)
                    self.assertEqual(self.saved(bp.proxy(vertices, triangles, **how)), wanted)
                    self.assertEqual(self.saved(bp.proxy(path, **how)), wanted)

    def test_arrays_hold_what_files_do(self):
        path, vertices, triangles = self.scene_file("torus")
        pipe(path, self.home / "tools.ply", [], ["--scale", "2%"], ["--faces", "200"])
        proxy = bp.proxy(vertices, triangles, 200, "2%")
        places, faces = read_ply(self.home / "tools.ply")
        self.assertTrue(np.array_equal(proxy.vertices, places) and np.array_equal(proxy.triangles, faces))

    def test_levels_and_quads(self):
        path, vertices, triangles = self.scene_file("bowl")
        levels = bp.proxy(vertices, triangles, [800, 300, 100], "2%")
        closed = tool("bpclose", "--scale", "2%", stdin=tool("bpvox", path))
        tool("bpmesh", "--faces", "800,300,100", "-o", self.home / "l.glb", stdin=closed)
        for i, level in enumerate(levels):
            self.assertEqual(self.saved(level), (self.home / f"l.{i}.glb").read_bytes())
        wanted = pipe(path, self.home / "q.obj", [], ["--scale", "2%"], ["--faces", "300", "--quads"])
        mesh = bp.proxy(vertices, triangles, 300, "2%", quads=True)
        self.assertEqual(self.saved(mesh, "obj"), wanted)
        self.assertGreater(len(mesh.quads), 10)

    def test_inside(self):
        path, vertices, triangles = self.scene_file("torus")
        wanted = pipe(path, self.home / "i.glb", ["--fill", "inside"], ["--scale", "1%"], ["--faces", "200"])
        grid = bp.voxelize(vertices, triangles, fill="inside").close("1%")
        self.assertEqual(self.saved(grid.mesh(200)), wanted)
        self.assertTrue(bp.check(grid.mesh(200), (vertices, triangles), inside=True))

    def test_grids(self):
        path, vertices, triangles = self.scene_file("soup")
        voxels = tool("bpvox", path, "--resolution", "100")
        grid = bp.voxelize(path, resolution=100)
        grid.save(self.home / "g")
        self.assertEqual((self.home / "g").read_bytes(), voxels)
        closed = tool("bpclose", "--scale", "3%", stdin=voxels)
        grid.close("3%").save(self.home / "c")
        self.assertEqual((self.home / "c").read_bytes(), closed)
        again = bp.load_grid(self.home / "c")
        self.assertEqual(self.saved(again.mesh(200)), self.saved(bp.voxelize(vertices, triangles, resolution=100).close("3%").mesh(200)))

    def test_rules(self):
        path, vertices, triangles = self.scene_file("torus")
        rules = {"base": "1%", "rules": [{"box": [[-3, -3, -1], [0, 3, 1]], "scale": "5%"}]}
        (self.home / "rules.json").write_text(json.dumps(rules))
        wanted = pipe(path, self.home / "r.glb", [], ["--field", self.home / "rules.json"], ["--faces", "400"])
        self.assertEqual(self.saved(bp.proxy(vertices, triangles, 400, rules=rules)), wanted)

    def test_fields_are_those_of_bpscale(self):
        cases = {"box": {"base": "1%", "rules": [{"box": [[-3, -3, -1], [0, 3, 1]], "scale": "5%"}]}, "base": {"base": 0.1},
                 "auto": {"base": "3%", "orientation": "auto"}, "gap": {"base": "3%", "rules": [{"gap": "8%"}]},
                 "frames": {"base": "2%", "orientation": [{"at": [0, 0, 0], "frame": [0.966, 0, 0, 0.259]}]}}
        for k, (case, rules) in enumerate(cases.items()):
            path, vertices, triangles = self.scene_file(list(SCENES)[k % len(SCENES)])
            (self.home / "rules.json").write_text(json.dumps(rules))
            voxels = tool("bpvox", path, "--resolution", "64")
            ruled = tool("bpscale", self.home / "rules.json", stdin=voxels)
            closed = tool("bpclose", stdin=ruled)
            tool("bpmesh", "--faces", "300", "-o", self.home / "f.glb", "--overwrite", stdin=closed)
            with self.subTest(case=case):
                grid = bp.voxelize(path, resolution=64).field(rules)
                for mine, wanted in ((grid, ruled), (grid.close(), closed)):
                    sink = io.BytesIO()
                    mine.save(sink)
                    self.assertEqual(sink.getvalue(), wanted)
                of_arrays = bp.field(bp.voxelize(vertices, triangles, resolution=64), json.dumps(rules)).close()
                self.assertEqual(self.saved(of_arrays.mesh(300)), (self.home / "f.glb").read_bytes())
                told = tool("bpscale", self.home / "rules.json", "--explain", "-1,0.5,0", stdin=voxels).decode()
                self.assertIn(f"{grid.scales([[-1, 0.5, 0]])[0]:.6g}", told)
                self.assertEqual(of_arrays.rules, grid.rules)

    def test_bytes_in_memory_are_those_of_files(self):
        mesh = bp.proxy(*torus(), 200, "2%", resolution=64, quads=True)
        for ending in ("ply", "obj"):
            sink = io.BytesIO()
            mesh.save(sink, format=ending)
            self.assertEqual(sink.getvalue(), self.saved(mesh, ending))
        levels = bp.levels(*torus(), [300, 60], resolution=64)
        bp.save_levels(levels, self.home / "levels", "n")
        self.assertEqual(bp.level_files(levels, "n"), {f.name: f.read_bytes() for f in (self.home / "levels").iterdir()})

    def test_levels_occluders_and_cages_are_the_files_of_bplod(self):
        makers = {"levels": bp.levels, "occluder": bp.occluder, "cage": bp.cage}
        cases = [("levels", "torus", dict(faces=[400, 100]), ["--faces", "400,100"]),
                 ("levels", "soup", dict(error="6%", levels=2, mode="fit"), ["--error", "6%", "--levels", "2", "--mode", "fit"]),
                 ("levels", "far boxes", dict(resolution=64), ["--resolution", "64"]),
                 ("levels", "bowl", dict(faces=300, levels=2, scale="2%", enclose="input", resolution=96, fill="winding", up="z"),
                  ["--faces", "300", "--levels", "2", "--scale", "2%", "--enclose", "input", "--resolution", "96", "--fill", "winding", "--up", "z"]),
                 ("occluder", "torus", dict(faces=100, resolution=128), ["--faces", "100", "--resolution", "128"]),
                 ("occluder", "soup", dict(scale=0, resolution=96), ["--scale", "0", "--resolution", "96"]),
                 ("cage", "torus", dict(faces=300, margin="1%"), ["--faces", "300", "--margin", "1%"]),
                 ("cage", "soup", dict(margin=0, symmetry="y", resolution=96), ["--margin", "0", "--symmetry", "y", "--resolution", "96"])]
        for profile, scene, how, options in cases:
            path, vertices, triangles = self.scene_file(scene)
            where = self.home / "tools"
            options = [*options, *(["--appearance", "off"] if profile == "levels" else ["--profile", profile])]
            try:
                tool("bplod", path, "-o", where, "--name", "n", *options)
            except AssertionError as e:
                self.assertIn("hides nothing", str(e))
                self.assertRaisesRegex(bp.InputError, "hides nothing", makers[profile], path, **how)
                continue
            for given in ((vertices, triangles), (path,)):
                with self.subTest(profile=profile, scene=scene, arrays=len(given) == 2):
                    mine = self.home / "mine"
                    bp.save_levels(makers[profile](*given, **how), mine, "n")
                    self.assertEqual({f.name: f.read_bytes() for f in mine.iterdir()}, {f.name: f.read_bytes() for f in where.iterdir()})
                    shutil.rmtree(mine)
            shutil.rmtree(where)

    def test_verdicts(self):
        path, vertices, triangles = self.scene_file("bowl")
        proxy = bp.proxy(vertices, triangles, 300, "2%")
        self.saved(proxy, "ply")
        told = json.loads(tool("bpcheck", "--json", path, self.home / "mine.ply"))
        verdict = bp.check(proxy, path)
        for name in ("file", "proxy", "scene"):
            for one in (told, verdict.json):
                if isinstance(one.get(name), str):
                    del one[name]
        self.assertEqual(verdict.json.keys(), told.keys())
        self.assertEqual(verdict.answer, "proven")
        self.assertEqual(bp.check(proxy, (vertices, triangles)).scene_to_proxy, verdict.scene_to_proxy)

    def test_points_in_a_cage_move_as_bpdeform_moves_them(self):
        path, vertices, triangles = self.scene_file("torus")
        proxy = bp.proxy(vertices, triangles, 150, "3%", resolution=64)
        order = np.unique(proxy.triangles.ravel(), return_index=True)[1].argsort()  # files number vertices by their first use
        number = np.empty(len(order), int)
        number[order] = np.arange(len(order))
        cage, faces = proxy.vertices[order], number[proxy.triangles]
        moved = cage + 0.1 * np.sin(3 * cage[:, ::-1])
        write_ply(self.home / "cage.ply", cage, faces)
        write_ply(self.home / "moved.ply", moved, faces)
        for kind, name in (("mean_value", "mean-value"), ("green", "green")):
            tool("bpdeform", "bind", path, self.home / "cage.ply", "--coordinates", name, "-o", self.home / "w.bpw", "--overwrite")
            tool("bpdeform", "apply", self.home / "w.bpw", self.home / "moved.ply", "-o", self.home / "out.ply", "--overwrite")
            places = read_ply(self.home / "out.ply")[0]
            self.assertTrue(np.array_equal(bp.bind((cage, faces), vertices, kind).apply(moved), places))

    def test_dense_voxels_are_those_of_the_bricks(self):
        grid = bp.voxelize(*torus(), resolution=90).close("3%")
        for layer in ("solid", "closing"):
            dense = grid.dense(layer)
            self.assertEqual(int(dense.sum()), grid.voxels[layer])
            coords = grid.brick_coords(layer)
            self.assertEqual(len(coords), grid.bricks[layer])
            for coord in coords:
                bits = np.unpackbits(grid.brick(coord, layer).view(np.uint8), bitorder="little").reshape(64, 64, 64)
                x, y, z = coord * 64 - grid.min
                self.assertTrue(np.array_equal(dense[z:z + 64, y:y + 64, x:x + 64], bits))
        self.assertTrue((grid.dense("closing") >= grid.dense("solid")).all())
        part = grid.dense("solid", grid.min + [3, 5, 7], grid.min + [50, 60, 70])
        self.assertTrue(np.array_equal(part, grid.dense("solid")[7:70, 5:60, 3:50]))


if __name__ == "__main__":
    unittest.main()
