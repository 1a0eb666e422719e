#!/usr/bin/env python3
"""The add-on without Blender: the manifest that Blender 4.2 and later read, the zip, and what its modules for files write and read."""
import importlib
import os
import re
import subprocess
import sys
import tempfile
import types
import unittest
import zipfile
from pathlib import Path

try:
    import tomllib

    import numpy as np
except ImportError as e:
    print(f"skipped: {e.name} is not there")
    sys.exit(77)

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "tools/blender/bounding_proxies_addon"


def module(name):
    """Loads a module of the add-on that needs no Blender, without its __init__.py."""
    package = sys.modules.setdefault("addon", types.ModuleType("addon"))
    package.__path__ = [str(FOLDER)]
    return importlib.import_module(f"addon.{name}")


class Manifest(unittest.TestCase):
    """The rules are those of Blender's manual, "How to Create Extensions"."""

    manifest = tomllib.loads((FOLDER / "blender_manifest.toml").read_text(encoding="utf-8"))

    def test_what_must_be_there_is(self):
        required = {"schema_version", "id", "version", "name", "tagline", "maintainer", "type", "blender_version_min", "license"}
        self.assertLessEqual(required, set(self.manifest))
        self.assertLessEqual(set(self.manifest) - required, {"tags", "permissions", "website", "copyright", "platforms", "wheels", "build"})
        self.assertEqual((self.manifest["schema_version"], self.manifest["type"]), ("1.0.0", "add-on"))

    def test_each_field_has_its_form(self):
        m = self.manifest
        self.assertEqual(m["id"], FOLDER.name)
        self.assertTrue(m["id"].isidentifier() and "__" not in m["id"])
        for text in (m["tagline"], *m["permissions"].values()):
            self.assertTrue(0 < len(text) <= 64 and text[-1].isalnum(), text)
        for version in (m["version"], m["blender_version_min"]):
            self.assertRegex(version, r"^\d+\.\d+\.\d+$")
        self.assertGreaterEqual(tuple(map(int, m["blender_version_min"].split("."))), (4, 2, 0))
        self.assertTrue(all(entry.startswith("SPDX:") for entry in m["license"]))
        self.assertLessEqual(set(m["permissions"]), {"files", "network", "clipboard", "camera", "microphone"})
        self.assertLessEqual(set(m["tags"]), {"3D View", "Game Engine", "Import-Export", "Mesh", "Modeling", "Object", "Physics", "Rigging", "UV"})

    def test_versions_agree(self):
        told = re.search(r'"version": \((\d+), (\d+), (\d+)\)', (FOLDER / "__init__.py").read_text(encoding="utf-8"))
        self.assertEqual(".".join(told.groups()), self.manifest["version"])
        self.assertEqual(os.environ.get("BP_VERSION", self.manifest["version"]), self.manifest["version"])
        guide = (ROOT / "docs/guides/blender.md").read_text(encoding="utf-8")
        self.assertIn(f"bounding_proxies_addon-{self.manifest['version']}.zip", guide)


class Zip(unittest.TestCase):
    def test_it_holds_all_modules_in_one_folder_and_is_the_same_each_time(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [Path(folder) / name for name in ("a.zip", "b.zip")]
            for path in paths:
                subprocess.run([sys.executable, ROOT / "tools/blender/pack.py", path], check=True, stdout=subprocess.DEVNULL)
            self.assertEqual(paths[0].read_bytes(), paths[1].read_bytes())
            names = set(zipfile.ZipFile(paths[0]).namelist())
        wanted = {path.name for path in FOLDER.iterdir() if path.suffix in (".py", ".toml")} | {"LICENSE"}
        self.assertEqual(names, {f"{FOLDER.name}/{name}" for name in wanted})


class Files(unittest.TestCase):
    """A tetrahedron that is sheared and mirrored, written for the tools and read back as text."""

    matrix = np.array([[1.1, 0.2, 0, 84900.3], [0, -0.9, 0.1, -5], [0.3, 0, 1.3, 0.1], [0, 0, 0, 1]], np.float32).astype(float)
    positions = np.array([[0.1, 0, 0], [1, 0, 0], [0, 1, 0.7], [0, 0, 1]], np.float32)
    triangles = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])

    def scene(self, **arrays):
        write = module("mesh_write")
        part = write.Part(self.positions, self.triangles, 0, **arrays)
        return write.Scene([[part]], [(0, self.matrix)], [write.Material(alpha=0.5, images={"map_Kd": 0})], [("png", b"image")], ["contract: inside"])

    def test_obj_holds_doubles_and_turns_mirrored_triangles_over(self):
        places = np.tile(np.array([[0, 0], [1, 0], [0, 1]], np.float32), (4, 1))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scene.obj"
            module("mesh_write").write_obj(path, self.scene(places=places))
            lines = [line.split() for line in path.read_text().splitlines()]
            material = path.with_suffix(".mtl").read_text()
            self.assertEqual((Path(folder) / "image0.png").read_bytes(), b"image")
        vertices = np.array([[float(word) for word in line[1:]] for line in lines if line[0] == "v"])
        exact = self.positions.astype(float)
        for k in range(3):
            wanted = self.matrix[k, 0] * exact[:, 0] + self.matrix[k, 1] * exact[:, 1] + self.matrix[k, 2] * exact[:, 2] + self.matrix[k, 3]
            self.assertTrue(np.array_equal(vertices[:, k], wanted))
        faces = [[int(word.split("/")[0]) - 1 for word in line[1:]] for line in lines if line[0] == "f"]
        self.assertGreater(sum(np.linalg.det(vertices[face] - vertices.mean(axis=0)) for face in faces), 0)
        self.assertEqual([line for line in lines if line[0] == "f"][0], ["f", "2/3", "3/2", "1/1"])
        self.assertIn(["#", "contract:", "inside"], lines)
        self.assertIn("map_Kd image0.png", material)
        self.assertIn("d 0.5", material)

    def test_ply_holds_the_same_vertices(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scene.ply"
            module("mesh_write").write_ply(path, self.scene())
            head, _, data = path.read_bytes().partition(b"end_header\n")
        self.assertIn(b"comment contract: inside", head)
        vertices = np.frombuffer(data, "<f8", 12).reshape(4, 3)
        self.assertTrue(np.array_equal(vertices, module("mesh_write").to_world(self.matrix, self.positions)))
        self.assertEqual(len(data), 4 * 24 + 4 * 13)

    def test_words_of_tools_are_sorted(self):
        notes, others = module("jobs").sort_words("bplod", ["bplod: note: a: b", "bplod: x.obj: bad", "bplod: the files are in made; prove it: ..."])
        self.assertEqual((notes, others), (["a: b"], ["x.obj: bad"]))


if __name__ == "__main__":
    unittest.main(verbosity=2)
