"""What can go wrong: the report tells it, the scene is as before, and no folder is left."""
import os
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # noqa: E402
from support import ADDON, AddonTest, main  # noqa: E402


def leftovers():
    return [name for name in os.listdir(tempfile.gettempdir()) if name.startswith("bounding-proxies-")]


class Errors(AddonTest):
    def setUp(self):
        super().setUp()
        self.before = leftovers()

    def tearDown(self):
        self.assertEqual(leftovers(), self.before)
        self.assertEqual([c.name for c in bpy.data.collections if c.name.endswith("proxies")], [])

    def test_no_selection(self):
        self.assertIn("Select the objects", self.refused("collision"))
        self.assertIn("Select a proxy", self.refused("check"))

    def test_a_tool_that_is_not_there(self):
        self.load("truck")
        path = os.environ["PATH"]
        try:
            os.environ["PATH"] = "/nonexistent"
            self.assertIn("bplod is not installed, or not on PATH", self.refused("cage"))
            bpy.context.preferences.addons[ADDON].preferences.folder = "/nonexistent"
            self.assertIn("bplod is not in /nonexistent", self.refused("cage"))
        finally:
            os.environ["PATH"] = path

    def test_an_object_without_faces(self):
        bpy.ops.object.empty_add()
        self.assertIn("has no faces", self.refused("hulls"))

    def test_the_words_of_the_tool(self):
        self.load("truck")
        self.settings.level_faces = "many"
        self.assertIn("--faces", self.refused("levels"))
        self.settings.level_faces = "100"
        self.settings.scale_kind, self.settings.scale_length = "LENGTH", 500
        words = self.refused("levels")
        self.assertIn("--scale 500", words)
        self.assertNotIn("bounding-proxies-", words)

    def test_coordinates_that_are_no_numbers_are_told(self):
        thing = self.load("truck")
        thing.data.vertices[0].co.x = float("nan")
        self.settings.check_after = True
        self.assertTrue(self.run_operator("collision"))
        [body] = self.kind("COLLISION")
        self.assertFalse(body["bp_proof"].startswith("holds"), body["bp_proof"])
        bpy.data.collections.remove(bpy.data.collections["truck proxies"])

    def test_cancel_ends_the_tool_and_changes_nothing(self):
        self.load("figure")
        self.settings.resolution, self.settings.level_faces = 900, "20000,5000"
        operators = sys.modules[f"{ADDON}.operators"]
        objects = [o.name for o in bpy.data.objects]

        def press_escape():
            while not operators.running or operators.running[0]._process is None:
                time.sleep(0.01)
            time.sleep(0.3)
            operators.running[0].cancel()

        threading.Thread(target=press_escape, daemon=True).start()
        begin = time.monotonic()
        self.assertFalse(self.run_operator("levels"))
        self.assertLess(time.monotonic() - begin, 4)
        self.assertEqual([o.name for o in bpy.data.objects], objects)
        self.assertEqual(operators.running, [])
        self.settings.resolution, self.settings.level_faces = 64, "200"
        self.assertTrue(self.run_operator("levels"))
        bpy.data.collections.remove(bpy.data.collections["figure proxies"])

    def test_nothing_is_proven_of_what_blender_does_not_show(self):
        thing = self.load("truck")
        self.assertTrue(self.run_operator("collision"))
        [body] = self.kind("COLLISION")
        thing.hide_set(True)
        body.select_set(True)
        self.assertTrue(self.run_operator("check"))  # the eye is opened for the proof, and closed again
        self.assertTrue(thing.hide_get())
        self.assertEqual(body["bp_proof"], "holds")
        bpy.context.view_layer.layer_collection.children[thing.users_collection[0].name].exclude = True
        self.assertIn("hidden by its collection, or not in this view layer", self.refused("check"))
        bpy.data.collections.remove(bpy.data.collections["truck proxies"])

    def test_an_object_that_is_deleted_meanwhile(self):
        thing = self.load("truck")
        operators = sys.modules[f"{ADDON}.operators"]
        advance = operators.Running._advance

        def meanwhile(operator, context):
            thing.name = "other"
            return advance(operator, context)

        operators.Running._advance = meanwhile
        try:
            self.assertIn("deleted or renamed", self.refused("collision"))
        finally:
            operators.Running._advance = advance


main(Errors)
