#!/usr/bin/env python3
"""What the Python module takes, and what it refuses with a clear error."""
import ast
import gc
import inspect
import os
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock
from pathlib import Path

from other_libraries import Meshio, meshes
from scenes import np, soup, torus, write_ply

import bounding_proxies as bp
from bounding_proxies import _library

QUICK = dict(faces=200, scale="3%", resolution=48)


def same(a, b):
    return np.array_equal(a.vertices, b.vertices) and np.array_equal(a.triangles, b.triangles)


def open_room():
    """A box of edge 1 whose lid has a square hole of edge 0.1: closed once openings are."""
    places, faces = [], []

    def quad(*corners):
        faces.extend(([len(places) + i for i in three] for three in ((0, 1, 2), (0, 2, 3))))
        places.extend(corners)
    quad((0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0))
    for a, b in (((0, 0), (1, 0)), ((1, 0), (1, 1)), ((1, 1), (0, 1)), ((0, 1), (0, 0))):
        quad((a[0], 0, a[1]), (b[0], 0, b[1]), (b[0], 1, b[1]), (a[0], 1, a[1]))
        inner = [(0.5 + 0.1 * (x - 0.5), 1, 0.5 + 0.1 * (z - 0.5)) for x, z in (b, a)]
        quad((a[0], 1, a[1]), (b[0], 1, b[1]), *inner)
    return np.array(places, float), np.array(faces)


class Inputs(unittest.TestCase):
    def setUp(self):
        self.vertices, self.triangles = torus(24, 12)
        self.wanted = bp.proxy(self.vertices, self.triangles, **QUICK)

    def refused(self, kind, words, function, *arguments, **named):
        with self.assertRaises(kind) as caught:
            function(*arguments, **named)
        self.assertRegex(str(caught.exception), words)

    def test_every_layout_and_type_gives_the_same_proxy(self):
        vertices, triangles = self.vertices, self.triangles
        wide = np.zeros((len(vertices), 7))
        wide[:, 2:5] = vertices
        for places in (vertices.tolist(), np.asfortranarray(vertices), wide[:, 2:5], vertices.astype(">f8"), vertices[::-1][::-1]):
            self.assertTrue(same(bp.proxy(places, triangles, **QUICK), self.wanted))
        padded = np.zeros((len(triangles), 5), np.int32)
        padded[:, :3] = triangles
        for faces in (triangles.astype("i4"), triangles.astype("i8"), triangles.astype("u8"), triangles.astype("u2"), triangles.astype("i2"),
                      triangles.astype(">i4"), padded[:, :3], triangles.tolist(), np.asfortranarray(triangles)):
            self.assertTrue(same(bp.proxy(vertices, faces, **QUICK), self.wanted))
        single = bp.proxy(vertices.astype("f4"), triangles, **QUICK)
        self.assertTrue(same(bp.proxy(vertices.astype("f4").astype("f8"), triangles, **QUICK), single))
        whole = (vertices * 10).astype(int)
        self.assertTrue(same(bp.proxy(whole, triangles, **QUICK), bp.proxy(whole.astype(float), triangles, **QUICK)))
        unaligned = np.frombuffer(b"x" + vertices.tobytes(), np.uint8)[1:].view(np.float64).reshape(-1, 3)
        self.assertTrue(same(bp.proxy(unaligned, triangles, **QUICK), self.wanted))

    def test_objects_of_other_libraries(self):
        forms = meshes(self.vertices, self.triangles)
        forms |= {"a pair": (self.vertices, self.triangles), "a Mesh of ours": self.wanted, "a Scene of ours": bp.Scene(forms["as trimesh"])}
        for name, thing in forms.items():
            with self.subTest(form=name):
                made = bp.proxy(thing, **QUICK)
                self.assertTrue(same(made, self.wanted) or name == "a Mesh of ours" and bp.check(made, self.wanted))
        for name, thing in meshes(self.wanted.vertices, self.wanted.triangles).items():
            with self.subTest(proxy=name):
                self.assertTrue(bp.check(thing, forms[name]))
                self.assertEqual(len(bp.bind(thing, self.vertices)), len(self.vertices))
        self.refused(bp.ArgumentError, "quad are no triangles", bp.proxy, Meshio(self.vertices, [("quad", np.zeros((1, 4), int))]))
        self.refused(TypeError, "int is no scene", bp.proxy, 3)

    def test_arrays_that_make_no_sense(self):
        v, t = self.vertices, self.triangles
        self.refused(ValueError, r"vertices: an array of shape \(288, 2\)", bp.proxy, v[:, :2], t)
        self.refused(ValueError, r"vertices: an array of shape \(864,\)", bp.proxy, v.ravel(), t)
        self.refused(ValueError, r"triangles: an array of shape .*split polygons", bp.proxy, v, np.zeros((4, 4), int))
        self.refused(TypeError, "triangles: an array of float64", bp.proxy, v, t.astype(float))
        self.refused(TypeError, "triangles: an array of bool", bp.proxy, v, t.astype(bool))
        self.refused(TypeError, "vertices: an array of complex128", bp.proxy, v.astype(complex), t)
        self.refused(TypeError, "vertices: an array of object", bp.proxy, v.astype(object), t)
        self.refused(bp.InputError, "there are no triangles", bp.proxy, v, t[:0])
        for number in (len(v), -1, 2**31 - 1, -2**31):
            bad = t.astype("i8")
            bad[7, 1] = number
            self.refused(bp.InputError, f"triangle 7 names vertex {number}, and the number of vertices is 288", bp.proxy, v, bad)
        for number in (np.nan, np.inf, -np.inf):
            bad = v.copy()
            bad[t[5, 0], 1] = number
            self.refused(bp.InputError, f"vertex {t[5, 0]} is not finite", bp.proxy, bad, t)
        unused = np.concatenate([v, [[np.nan] * 3]])
        self.assertTrue(same(bp.proxy(unused, t, **QUICK), self.wanted))
        self.refused(bp.InputError, "no triangle|area", bp.proxy, np.zeros((3, 3)), np.array([[0, 1, 2]]))

    def test_words(self):
        for up in ("x", "-x", "y", "-y", "z", "-z"):
            with self.subTest(up=up):
                self.assertEqual(len(bp.proxy(self.vertices, self.triangles, faces=12, resolution=16, up=up).triangles) % 2, 0)

    def test_options_that_make_no_sense(self):
        v, t = self.vertices, self.triangles
        for how, words in ((dict(faces=0), "no number of triangles"), (dict(faces=[100, 100]), "fewer than the one before"),
                           (dict(faces=-3), "no number of triangles"), (dict(scale="x"), "'x'"), (dict(scale=-1.0), "scale: -1 is no length"),
                           (dict(scale=float("nan")), "is no length"), (dict(scale="3cm"), "cm"), (dict(mode="around"), "mode: 'around' is none of"),
                           (dict(element="box"), "element"), (dict(up="w"), "up"), (dict(fill="all"), "fill"),
                           (dict(resolution=10, voxel=0.1), "voxel and resolution exclude each other"), (dict(resolution=-5), "resolution"),
                           (dict(rules="{"), "rules"), (dict(rules={"base": "1%"}, scale="1%"), "scale and rules exclude each other"),
                           (dict(threads=-1), "threads"), (dict(device="tpu"), "none of auto, cpu"), (dict(temp="/no/such"), "no such directory"),
                           (dict(volume=-1), "volume"), (dict(error="-1"), "-1"), (dict(voxel="3vx"), "not measured in voxels"),
                           (dict(resolution=2**40), "no number from 1 to 2147483647"),
                           (dict(resolution=0), "from 1"), (dict(voxel=0), "voxel: 0 is no length above 0"), (dict(resolution=True), "no whole number")):
            with self.subTest(how=how):
                self.refused(bp.Error, words, bp.proxy, v, t, **how)
        self.refused(TypeError, "is no length", bp.proxy, v, t, scale=[1])
        self.refused(TypeError, r"proxy\(\) got an unexpected keyword argument 'scael'; did you mean 'scale'", bp.proxy, v, t, scael=1)
        self.refused(TypeError, r"levels\(\) got .* 'thread'; did you mean 'threads'", bp.levels, v, t, thread=1)
        self.refused(TypeError, r"info\(\) got .* 'xyz'; it has threads, memory", bp.Scene(v, t).info, xyz=1)
        self.refused(TypeError, r"Options\(\) got .* 'memmory'; did you mean 'memory'", bp.Options, memmory=1)
        self.refused(bp.ResourceError, "memory", bp.proxy, v, t, memory=1000)
        self.refused(bp.ResourceError, "--memory|memory 1 MiB", bp.proxy, v, t, memory="1M")

    def test_texts_are_read_as_the_tools_read_them_or_refused_with_what_to_write(self):
        v, t = self.vertices, self.triangles
        for name, text, words in (("memory", "64X", "no size; .*'4G'"), ("memory", "", "no size"), ("memory", -1, "no number"),
                                  ("memory", [1], "no whole number"), ("faces", "many", "no number of triangles; write faces=400"),
                                  ("faces", "400,x", "'x' is no number of triangles"), ("faces", "", "no number of triangles"),
                                  ("faces", 1.5, "no number of triangles"), ("faces", float("nan"), "no number of triangles"),
                                  ("faces", [[1]], "no number of triangles"), ("threads", "2", "threads: '2' is no whole number; write it without quotes"),
                                  ("threads", 1.5, "no whole number"), ("resolution", "64", "resolution: '64' is no whole number"),
                                  ("volume", "big", "volume: 'big' is no number"), ("device", 0, "device: 0 is no text"),
                                  ("progress", 3, "progress: 3 is no function")):
            with self.subTest(name=name, text=text):
                self.refused(bp.ArgumentError, words, bp.proxy, v, t, **{name: text})
        self.refused(bp.ArgumentError, "hulls: '8' is no whole number", bp.hulls, self.wanted, "8")
        self.refused(bp.ArgumentError, "levels: 'two' is no whole number", bp.levels, v, t, levels="two")
        self.assertEqual([bp.Options(memory=text).memory for text in ("64", "2K", "64M", "1.5GiB", "4GB", 7.0)],
                         [64, 2048, 64 << 20, 3 << 29, 4 << 30, 7])
        self.assertTrue(same(bp.proxy(v, t, **{**QUICK, "faces": "200", "memory": "2G"}), self.wanted))
        levels = bp.proxy(v, t, **{**QUICK, "faces": "200,60"})
        self.assertEqual(len(levels), 2)
        self.assertTrue(all(same(a, b) for a, b in zip(levels, bp.proxy(v, t, **{**QUICK, "faces": [200, 60]}))))

    def test_a_gpu_is_used_or_its_lack_is_told(self):
        for call in (lambda: bp.proxy(self.vertices, self.triangles, device="cuda", **QUICK),
                     lambda: bp.levels(self.vertices, self.triangles, 100, levels=1, resolution=48, device="cuda")):
            try:
                mesh = call()
            except bp.ResourceError as e:
                self.assertRegex(str(e), "no GPU support; rebuild with|no GPU was found; check the driver")
            else:
                self.assertTrue(mesh)
        self.assertTrue(same(bp.proxy(self.vertices, self.triangles, device="cpu", **QUICK), self.wanted))

    def test_messages_name_members_as_the_library_does(self):
        with self.assertRaises(bp.Error) as caught:
            bp.proxy(self.vertices, self.triangles, scale=1e9)
        self.assertNotIn("--", str(caught.exception))
        self.assertIn("scale", str(caught.exception))

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scene.ply"
            write_ply(path, self.vertices, self.triangles)
            self.assertTrue(same(bp.proxy(str(path), **QUICK), self.wanted))
            self.refused(bp.InputError, "missing.ply", bp.proxy, Path(folder) / "missing.ply")
            path.with_name("half.ply").write_bytes(path.read_bytes()[:300])
            self.refused(bp.InputError, "half.ply", bp.proxy, path.with_name("half.ply"))
            self.refused(bp.ArgumentError, "stdin", bp.proxy, "-")
            self.refused(bp.InputError, "scene.ply", bp.load_grid, path)
            out = Path(folder) / "p.ply"
            self.wanted.save(out)
            self.refused(bp.ArgumentError, "exists", self.wanted.save, out)
            self.refused(bp.ArgumentError, "step", self.wanted.save, Path(folder) / "p.step")
            self.wanted.save(out, overwrite=True)
            again = bp.load(out)[0]
            self.assertTrue(bp.check(again, path) and bp.check(out, path))
            self.assertAlmostEqual(again.volume, self.wanted.volume, 12)
            self.refused(bp.ArgumentError, "loaded", again.save, Path(folder) / "q.ply")
            info = bp.Scene([path, path]).info()
            self.assertEqual(info["triangles"], 2 * len(self.triangles))
            self.assertTrue(np.array_equal(info["min"], self.vertices.min(0)))

    def test_a_field_tells_the_scales(self):
        grid = bp.voxelize(self.vertices, self.triangles, resolution=48)
        self.assertIsNone(grid.rules)
        ruled = grid.field({"base": 0.1, "rules": [{"at": [2, 0, 0], "radius": 0.3, "scale": 0.4}]})
        self.assertEqual((ruled.rules["base"], ruled.rules["rules"][0]["scale"], ruled.has_closing), (0.1, 0.4, False))
        self.assertTrue(np.allclose(ruled.scales([[2, 0, 0], [-2, 0, 0]]), [0.4, 0.1]))
        self.assertEqual(ruled.scales(np.empty((0, 3))).shape, (0,))
        closed = ruled.close()
        self.assertEqual(closed.rules, ruled.rules)
        self.assertTrue(bp.check(closed.mesh(300), (self.vertices, self.triangles)))
        self.assertEqual(set(grid.close("2%").rules), {"base"})
        self.refused(bp.ArgumentError, "the grid has no scales", grid.scales, [[0, 0, 0]])
        self.refused(bp.ArgumentError, "closed already", closed.field, {"base": 1})
        self.refused(bp.ArgumentError, "the grid has a field", ruled.close, "2%")
        self.refused(bp.InputError, "rules", grid.field, "{")
        self.refused(bp.InputError, "bse", grid.field, {"bse": 1})
        self.refused(bp.InputError, "point 1 is not finite", ruled.scales, [[0, 0, 0], [0, np.nan, 0]])
        self.refused(ValueError, r"points: an array of shape \(3,\)", ruled.scales, [0, 0, 0])
        self.refused(bp.InputError, "names no scene file", grid.field, {"base": 1, "rules": [{"node": "pipe", "scale": 2}]})

    def test_an_error_of_what_takes_bytes_is_raised(self):
        class Full:
            def write(self, data):
                raise OSError(28, "full")
        grid = bp.voxelize(self.vertices, self.triangles, resolution=48)
        for save, how in ((self.wanted.save, dict(format="glb")), (grid.save, {})):
            self.refused(OSError, "full", save, Full(), **how)
        self.refused(bp.ArgumentError, "format", self.wanted.save, Full())
        self.refused(bp.ArgumentError, "step", self.wanted.save, Full(), format="step")
        self.refused(bp.ArgumentError, "format", self.wanted.save, "x.glb", format="glb")
        self.refused(bp.ArgumentError, "bp_levels_write", bp.level_files, self.wanted)

    def test_a_change_of_borrowed_arrays_is_reported(self):
        vertices = self.vertices.copy()
        grid = bp.voxelize(bp.Scene(vertices, self.triangles, copy=False), resolution=48)
        vertices[3, 0] += 0.5
        self.refused(bp.InputError, "not those that were voxelized", grid.mesh, 200)
        kept = bp.voxelize(bp.Scene(self.vertices.copy(), self.triangles.copy(), copy=False), resolution=48).close("3%")
        gc.collect()
        rest = [np.ones_like(self.vertices) for _ in range(50)]  # where freed arrays would have been
        self.assertTrue(len(rest) and bp.check(kept.mesh(200), (self.vertices, self.triangles)))
        own = bp.voxelize(bp.Scene(self.vertices.copy(), self.triangles), resolution=48)
        self.assertTrue(bp.check(own.mesh(200), (self.vertices, self.triangles)))

    def test_a_false_proxy_is_refuted(self):
        moved = self.wanted.vertices + [0.4, 0, 0]
        verdict = bp.check((moved, self.wanted.triangles), (self.vertices, self.triangles))
        self.assertEqual((verdict.answer, verdict.sound, verdict.placed), ("refuted", "proven", "refuted"))
        self.assertGreater(verdict.touching + verdict.outside, 0)
        self.assertIn("outside", verdict.reasons + verdict.text)
        self.assertEqual(bp.check(soup(50)).answer, "refuted")
        self.refused(bp.ArgumentError, "scene", bp.check, self.wanted, margin=1.0)

    def test_hulls_enclose_what_the_proxy_does(self):
        hulls = bp.hulls(self.wanted, 8)
        self.assertTrue(2 <= len(hulls) <= 8)
        for hull in hulls:
            self.assertTrue(bp.check(hull, convex=True, distances=False))
        first = np.cumsum([0] + [len(h.vertices) for h in hulls])
        all_vertices = np.concatenate([h.vertices for h in hulls])
        all_triangles = np.concatenate([h.triangles.astype(int) + n for h, n in zip(hulls, first)])
        self.assertTrue(bp.check((all_vertices, all_triangles), (self.vertices, self.triangles), convex=True))
        self.refused(bp.ArgumentError, "corners", bp.hulls, self.wanted, corners=3)
        self.refused(TypeError, "no Mesh", bp.hulls, (self.vertices, self.triangles))

    def test_levels_occluders_and_cages_are_proven(self):
        scene = (self.vertices, self.triangles)
        levels = bp.levels(*scene, [400, 60])
        self.assertEqual([len(level.triangles) for level in levels], [400, 60])
        self.assertTrue(0 < levels[0].error_bound < levels[1].error_bound and levels[0].enclosed == "scene")
        for level in levels:
            verdict = bp.check(level, scene)
            self.assertTrue(verdict and verdict.proxy_to_scene <= level.error_bound)
        self.assertTrue(bp.check(bp.occluder(*scene, 60, resolution=96), scene, inside=True))
        room = open_room()
        occluder = bp.occluder(*room, 60, resolution=64)
        self.assertTrue(bp.check(occluder, room, inside=True))
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = str(Path(folder.name) / "occluder.glb")
        occluder.save(path)
        self.assertTrue(bp.check(path, room, inside=True))
        self.refused(bp.ArgumentError, "inside", bp.check, occluder, room, inside=True, convex=True)
        diagonal = np.linalg.norm(np.ptp(self.vertices, 0))
        for margin, wanted in (("2%", 0.02 * diagonal), (0.1, 0.1), (None, 0.005 * diagonal)):
            cage = bp.cage(*scene, 300, margin=margin, symmetry="off")
            self.assertTrue(bp.check(cage, scene, margin=wanted))
            self.assertGreater(len(cage.quads), 50)
        half = bp.cage(*scene, 300, symmetry="x").vertices
        middle = (half.min(0) + half.max(0)) / 2
        places = [{tuple(np.round(p, 6) + 0.0) for p in (half - middle) * [side, 1, 1]} for side in (1, -1)]
        self.assertEqual(*places)
        with tempfile.TemporaryDirectory() as folder:
            for overwrite in (False, True):  # a name may be written again in a process
                bp.save_levels(levels, Path(folder) / "new", "house", overwrite=overwrite)
            self.assertEqual(sorted(os.listdir(Path(folder) / "new")), ["house.glb", "house_LOD0.glb", "house_LOD1.glb"])
            self.refused(bp.ArgumentError, "exists", bp.save_levels, levels, Path(folder) / "new", "house")
            self.refused(bp.ArgumentError, "without a folder", bp.save_levels, levels, folder, "a/b")
            self.refused(bp.ArgumentError, "name: is empty", bp.save_levels, levels, folder, "")
            self.refused(bp.ArgumentError, "bp_levels_save", bp.save_levels, self.wanted, folder)
            self.refused(TypeError, "save_levels", bp.save_levels, [], folder)

    def test_levels_that_make_no_sense(self):
        scene = (self.vertices, self.triangles)
        for how, words in ((dict(faces=[100, 200]), "fewer than the one before"), (dict(faces=0), "no number"),
                           (dict(faces=100, error="1%"), "exclude each other"), (dict(error="0"), "errors: 0"), (dict(error="-1%"), "no length|-1"),
                           (dict(error=["2%", "1%"]), "larger one"), (dict(error=["1%", 2.0]), "one unit"), (dict(error="3vx"), "in voxels"),
                           (dict(levels=33), "1 to 32"), (dict(levels=0), "levels: 0"), (dict(faces=[300, 100], levels=3), "lists 2 numbers"),
                           (dict(mode="inside"), "mode"), (dict(mode="fit", enclose="scene"), "a fit encloses nothing"),
                           (dict(fill="inside"), "fill"), (dict(scale=-1.0), "scale"), (dict(resolution=10, voxel=1.0), "exclude each other")):
            with self.subTest(how=how):
                self.refused(bp.Error, words, bp.levels, *scene, **how)
        self.refused(bp.Error, "no number", bp.occluder, *scene, 0)
        self.refused(bp.Error, "scale", bp.occluder, *scene, scale=-1.0)
        self.refused(bp.InputError, "hides nothing", bp.occluder, np.eye(3), [[0, 1, 2]], resolution=32)
        self.refused(bp.Error, "symmetry", bp.cage, *scene, symmetry="w")
        self.refused(bp.Error, "margin", bp.cage, *scene, margin=float("nan"))
        self.refused(bp.Error, "margin", bp.cage, *scene, margin=1e9, resolution=32)
        self.refused(bp.ArgumentError, "cage of a grid", bp.cage, bp.voxelize(*scene, resolution=32), 100, margin="1%")
        self.refused(bp.ArgumentError, "faces", bp.cage, bp.voxelize(*scene, resolution=32))
        self.refused(bp.ResourceError, "memory", bp.levels, *scene, memory=1000)

    def test_points_follow_their_cage(self):
        turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 2.0]])
        for kind in ("mean_value", "maximum_likelihood"):
            weights = bp.bind(self.wanted, self.vertices, kind)
            self.assertEqual(len(weights), len(self.vertices))
            self.assertTrue(np.array_equal(weights.apply(self.wanted.vertices), self.vertices))
            moved = weights.apply(self.wanted.vertices @ turn.T + [1, 2, 3])
            self.assertLess(np.abs(moved - (self.vertices @ turn.T + [1, 2, 3])).max(), 1e-5)
        out = np.empty_like(self.vertices)
        self.assertIs(weights.apply(self.wanted.vertices, out), out)
        self.refused(ValueError, "contiguous", weights.apply, self.wanted.vertices, out[:, ::-1])
        self.refused(bp.ArgumentError, "an array of 5 rows, and the number of the cage's vertices is", weights.apply, self.vertices[:5])
        self.refused(bp.InputError, "outside the cage: 1 of 1", bp.bind, self.wanted, [[99, 0, 0]])
        self.assertEqual(len(bp.bind(self.wanted, [[99.0, 0, 0]], carry_outside=True)), 1)
        self.refused(bp.InputError, "not finite", bp.bind, self.wanted, [[np.nan, 0, 0]])
        self.refused(bp.InputError, "cage", bp.bind, (self.vertices, self.triangles[1:]), self.vertices)

    def test_a_cage_of_quads_encloses_the_scene(self):
        cage = bp.cage(bp.voxelize(self.vertices, self.triangles, resolution=64).close("4%"), 300)
        self.assertTrue(100 < len(cage.triangles) <= 300 and 2 * len(cage.quads) == len(cage.triangles))
        self.assertTrue(bp.check(cage, (self.vertices, self.triangles)))
        self.assertEqual(len(bp.bind(cage, self.vertices)), len(self.vertices))
        self.refused(bp.ArgumentError, "at least 12", bp.cage, bp.voxelize(self.vertices, self.triangles, resolution=64), 4)

    def test_structs_are_laid_out_as_in_the_header(self):
        names = {"bp_length": "Length", "bp_run": "Run", "bp_arrays": "Arrays", "bp_scene_info": "SceneInfo", "bp_grid_info": "GridInfo",
                 "bp_mesh_view": "MeshView", "bp_mesh_info": "MeshInfo", "bp_verdict_info": "VerdictInfo"}
        lines = subprocess.run([os.environ["BP_LAYOUT"]], capture_output=True, text=True, check=True).stdout.split("\n")
        for what, number in (line.split() for line in lines if line):
            struct, _, member = what.partition(".")
            name = names.get(struct) or "".join(w.capitalize() for w in struct.split("_")[1:])
            cls = getattr(_library, name)
            mine = getattr(cls, member).offset if member else _library.sizeof(cls)
            self.assertEqual(mine, int(number), what)

    def test_the_package_has_the_version_of_the_library(self):
        setup = Path(bp.__file__).parents[1] / "setup.py"
        names = {"__file__": str(setup)}
        fake = types.ModuleType("setuptools")  # which need not be installed
        fake.setup = lambda version: names.update(told=version)
        with unittest.mock.patch.dict(sys.modules, setuptools=fake):
            exec(compile(setup.read_text(encoding="utf-8"), str(setup), "exec"), names)  # a file of ours
        self.assertEqual(names["told"], bp.library_version())
        self.assertEqual(bp.__version__, bp.library_version())

    def test_objects_tell_what_they_are(self):
        vertices, triangles = torus(16, 8)
        grid = bp.voxelize(vertices, triangles, resolution=16)
        self.assertRegex(repr(grid), r"^<bounding_proxies\.Grid: \d+ voxels of 0\.\d+ in its solid layer>$")
        self.assertRegex(repr(grid.mesh(100)), r"Mesh: \d+ vertices, \d+ triangles>$")

    def test_the_stubs_have_the_signatures_of_the_module(self):
        stub = ast.parse(Path(bp.__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
        told = {node.name: node for node in stub.body if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not node.name.startswith("_")}
        self.assertEqual(sorted(told), sorted(bp.__all__))
        functions = {name: (node, getattr(bp, name)) for name, node in told.items() if isinstance(node, ast.FunctionDef)}
        for name, node in told.items():
            for inner in node.body if isinstance(node, ast.ClassDef) else ():
                if isinstance(inner, ast.FunctionDef) and not any(isinstance(d, ast.Name) and d.id == "property" for d in inner.decorator_list):
                    functions[f"{name}.{inner.name}"] = (inner, getattr(getattr(bp, name), inner.name))
        for name, (node, function) in functions.items():
            mine = inspect.signature(function).parameters
            a = node.args
            wanted = [x.arg for x in [*a.posonlyargs, *a.args, *a.kwonlyargs]] + ([a.kwarg.arg] if a.kwarg else [])
            hidden = ["unknown"] if name == "Options.__init__" else []  # takes what is misspelt, to refuse it
            self.assertEqual([n for n in mine if n not in hidden], wanted, name)
            self.assertTrue(function.__doc__ or name.endswith(("__", "mesh.faces")), f"{name} has no text")


if __name__ == "__main__":
    unittest.main()
