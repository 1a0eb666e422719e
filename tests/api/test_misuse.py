#!/usr/bin/env python3
"""Calls of the Python module that make no sense: every one ends with a result, or with an error that a user understands.
BP_TURNS: random calls of each kind (300). tests/large/library.sh runs this with the sanitized library."""
import copy
import inspect
import os
import pickle
import tempfile
import types
import unittest
import warnings
from ctypes import byref, c_uint64, c_void_p
from pathlib import Path

from scenes import np, torus, write_ply

import bounding_proxies as bp
from bounding_proxies import _library

TURNS = int(os.environ.get("BP_TURNS", "300"))
QUICK = dict(faces=60, resolution=16)
VALUES = [None, True, 0, 1, 5, -1, 2**31, 2**63, 2**70, 10**400, 0.5, 1.5, -0.0, float("nan"), float("inf"), 1j, "", "x", "5", "2%", "-1%", "1e400%", "3vx",
          "400,100", "2%\0", "\ud800", b"2%", "inside", "none", "closing", "ball", "fit", "z", "green", "64M", "/no/such/folder", "/proc/version", [], [1],
          ["2%", "3%"], [[1], [1, 2]], (1, 2, 3), {}, {"base": "1%"}, {"base": object()}, np.float32(3), np.int64(5), np.zeros(3), np.zeros((0, 3)),
          np.array("x"), np.array([9, 4]), np.full((2, 3), np.nan), object(), int, Path("x"), types.SimpleNamespace(vertices=3, faces=None),
          types.SimpleNamespace(points=[], cells=[])]


class Misuse(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = torus(16, 8)
        cls.mesh = bp.proxy(*cls.scene, **QUICK)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def refused(self, kind, words, function, *arguments, **named):
        with self.assertRaises(kind) as caught:
            function(*arguments, **named)
        self.assertRegex(str(caught.exception), words)

    def clear(self, function, *arguments, **named):
        """Calls, and returns whether there was a result."""
        try:
            with warnings.catch_warnings(), np.errstate(all="ignore"):
                warnings.simplefilter("ignore")
                function(*arguments, **named)
        except (bp.Error, ValueError, TypeError) as e:
            self.assertGreater(len(str(e)), 12)
            self.assertNotRegex(str(e), "unexpected failure|NoneType' object|_handle|no attribute")
            return False
        return True

    def test_random_arguments_give_a_result_or_a_clear_error(self):
        grid = bp.voxelize(*self.scene, resolution=16).close("5%")
        weights = bp.bind(self.mesh, self.scene[0])
        write_ply("scene.ply", *self.scene)
        base = [(bp.proxy, (*self.scene,), QUICK), (bp.proxy, ("scene.ply",), QUICK), (bp.voxelize, (*self.scene,), dict(resolution=16)),
                (bp.close, (grid, "5%"), {}), (bp.mesh, (grid, 60), {}), (bp.check, (self.mesh, self.scene), {}),
                (bp.bind, (self.mesh, self.scene[0]), {}), (bp.hulls, (self.mesh, 4), {}), (bp.load, ("scene.ply",), {}), (bp.load_grid, ("g.bpv",), {}),
                (bp.save_levels, (self.mesh, "out"), {}), (bp.Scene, (*self.scene,), {}), (bp.Scene(*self.scene).info, (), {}), (bp.Options, (), {}),
                (bp.levels, (*self.scene, 60), dict(levels=1, resolution=16)), (bp.occluder, (*self.scene, 60), dict(resolution=24)),
                (bp.cage, (*self.scene, 60), dict(resolution=16)), (bp.cage, (grid, 60), {}), (grid.dense, (), {}), (grid.brick, ([0, 0, 0],), {}),
                (grid.brick_coords, (), {}), (grid.save, ("g.bpv",), {}), (self.mesh.save, ("m.ply",), {}), (weights.apply, (self.mesh.vertices,), {}),
                (bp.field, (bp.voxelize(*self.scene, resolution=16), {"base": "3%"}), {}), (grid.scales, (self.scene[0],), {}),
                (bp.level_files, (self.mesh,), {})]
        random = np.random.default_rng(7)
        made = 0
        for turn in range(max(TURNS, 20 * len(base))):
            function, positional, named = base[turn % len(base)]
            names = [n for n, p in inspect.signature(function).parameters.items() if p.kind not in (p.VAR_KEYWORD, p.VAR_POSITIONAL)]
            call = {**dict(zip(names, positional)), **named}
            if "run" in inspect.signature(function).parameters:
                names += ["threads", "memory", "temp", "device", "progress"]
            for name in random.choice(names, min(len(names), 1 + turn % 2), replace=False):
                call[name] = VALUES[random.integers(len(VALUES))]
            with self.subTest(function=function.__name__, arguments={n: v for n, v in call.items() if not isinstance(v, np.ndarray)}):
                made += self.clear(function, **call)
        self.assertGreater(made, 20)

    def test_random_arrays_give_a_proxy_or_a_clear_error(self):
        random = np.random.default_rng(5)
        types_of_vertices = ["f4", "f8", ">f8", "f2", "i2", "u1", "c8", "?", "S3", "O"]
        types_of_triangles = ["u4", "i4", "i8", "u8", ">i4", "u2", "i1", "f8", "?", "O"]
        made = refused = 0
        for turn in range(TURNS):
            n, m = random.integers(0, 12, 2)
            vertices = random.normal(0, 10.0 ** random.integers(-3, 4), (n, random.choice([3, 3, 3, 2, 4])))
            triangles = random.integers(-1 if turn % 5 == 0 else 0, max(n, 1) + (turn % 3 == 0), (m, random.choice([3, 3, 3, 4, 1])))
            if n > 0 and turn % 4 == 0:
                vertices[random.integers(n), 0] = random.choice([np.nan, np.inf, 1e308, 1e-320, -0.0])
            with np.errstate(all="ignore"), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                vertices = vertices.astype(random.choice(types_of_vertices) if turn % 2 else "f8")
                triangles = triangles.astype(random.choice(types_of_triangles) if turn % 2 else "i8")
            shape = random.integers(8)
            if shape == 1:
                vertices = np.asfortranarray(vertices)
            elif shape == 2:
                triangles = triangles[::-1]
            elif shape == 3:
                vertices = np.repeat(vertices, 2, 0)[::2]
            elif shape == 4 and n:
                vertices = np.broadcast_to(vertices[:1], vertices.shape)
            elif shape == 5:
                triangles = np.asfortranarray(np.repeat(triangles, 2, 1))[:, ::2]
            elif shape == 6:
                vertices = vertices[:, ::-1]
            elif shape == 7:
                vertices = np.lib.stride_tricks.as_strided(vertices, (max(n, 1) - 1, 3), (vertices.strides[0], 0)) if n else vertices
            done = self.clear(bp.proxy, vertices, triangles, faces=50, resolution=16)
            made, refused = made + done, refused + (not done)
            self.clear(bp.bind, self.mesh, vertices)
            self.clear(bp.check, (vertices, triangles), self.scene)
        self.assertTrue(made > 10 and refused > 100, (made, refused))

    def test_sizes_that_the_tools_refuse(self):
        for text in ("5iB", "iB", "4iB", "4Gi", "G", "4g", "4 G", "-1G", "nan"):
            self.refused(bp.ArgumentError, "no size; .*'4G'", bp.Options, memory=text)
        self.assertEqual([bp.Options(memory=text).memory for text in ("5B", "5KB", "5KiB")], [5, 5120, 5120])

    def test_copies_share_the_object_and_pickles_are_refused(self):
        grid = bp.voxelize(bp.Scene(*self.scene, copy=False), resolution=16)
        for thing in (bp.Scene(*self.scene), grid, self.mesh, bp.bind(self.mesh, self.scene[0])):
            for again in (copy.copy(thing), copy.deepcopy(thing), copy.deepcopy([thing])[0]):
                self.assertIs(again, thing)
            self.refused(TypeError, f"a {type(thing).__name__} .*cannot be pickled", pickle.dumps, thing)
        verdict = bp.check(self.mesh, self.scene)
        self.assertEqual(pickle.loads(pickle.dumps(verdict)).text, verdict.text)

    def test_one_thing_in_place_of_another(self):
        mesh_object = types.SimpleNamespace(vertices=self.scene[0], faces=self.scene[1])
        for scene, beside in (("scene.ply", 500), (Path("scene.ply"), "500"), (mesh_object, 500), (mesh_object, self.scene[1]), (self.mesh, 1.5),
                              (bp.Scene(*self.scene), 500), (self.scene, 500), (["scene.ply"], 500)):
            self.refused(bp.ArgumentError, "triangles: .* is given beside .*by their names, such as faces=1000", bp.proxy, scene, beside)
        self.refused(TypeError, r"str is no Grid; give what voxelize\(\) or close\(\) returned", bp.mesh, "scene.ply")
        self.refused(AttributeError, "a Grid has no 'closing'; it has voxel, origin", lambda: bp.voxelize(*self.scene, resolution=16).closing)
        self.refused(TypeError, "tuple is no Grid", bp.close, self.scene)
        self.refused(TypeError, "list is no Mesh", bp.hulls, [self.mesh])
        self.refused(TypeError, "out: list is no array", bp.bind(self.mesh, self.scene[0]).apply, self.mesh.vertices, [1])
        self.refused(ValueError, "vertices: no array", bp.proxy, [[0, 0, 0], [1, 2]], [[0, 1, 1]])
        self.refused(bp.ArgumentError, "scale: .* number 0", bp.proxy, *self.scene, scale="2%\0")
        self.refused(bp.ArgumentError, "path: .* number 0", self.mesh.save, "a\0.glb")
        self.refused(bp.ArgumentError, "format: 3 is no text", bp.Scene, "scene", format=3)

    def test_a_list_without_its_number_is_refused(self):
        scene, out, faces, errors = bp.Scene(*self.scene), c_void_p(), (c_uint64 * 1)(60), (_library.Length * 1)()
        mesh, levels = _library.MeshOptions.made(), _library.LevelsOptions.made()
        mesh.faces, levels.faces = faces, faces
        calls = [("bp_proxy", (None, None, byref(mesh)), "levels: it is 0, and faces is set"), ("bp_levels", (None, byref(levels)), "face_count: it is 0")]
        levels_by_error = _library.LevelsOptions.made()
        levels_by_error.errors = errors
        calls.append(("bp_levels", (None, byref(levels_by_error)), "error_count: it is 0, and errors is set"))
        for function, options, words in calls:
            self.assertEqual(getattr(_library.lib(), function)(scene._handle.address, *options, None, byref(out)), 2)
            self.assertIn(words, _library.lib().bp_error_message().decode())


if __name__ == "__main__":
    unittest.main()
