"""What the tests of the add-on share. They run within Blender, without a window, and with the add-on as its zip installs it."""
import os
import sys
import unittest
from pathlib import Path

import bpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree

ADDON = "bounding_proxies_addon"
SCENES = Path(os.environ["BP_SCENES"])  # the files of samples/scenes.py and samples/town.py


class AddonTest(unittest.TestCase):
    """Begins with an empty scene, in which nothing is proven unless a test asks for it."""

    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.preferences.addon_enable(module=ADDON)
        collection = bpy.data.collections.new("models")
        bpy.context.scene.collection.children.link(collection)
        bpy.context.view_layer.active_layer_collection = bpy.context.view_layer.layer_collection.children[0]
        self.settings = bpy.context.scene.bounding_proxies
        self.settings.check_after, self.settings.precision = False, 4
        self.settings.grid_kind, self.settings.resolution = "RESOLUTION", 64

    def load(self, name):
        """Imports a scene. Returns the object, which is selected."""
        bpy.ops.wm.obj_import(filepath=str(SCENES / f"{name}.obj"))
        thing = bpy.context.selected_objects[0]
        bpy.context.view_layer.objects.active = thing
        return thing

    def ball(self, name):
        """Adds a ball, where the shape does not matter: it takes little time."""
        bpy.ops.mesh.primitive_uv_sphere_add(radius=2)
        bpy.context.active_object.name = name
        return bpy.context.active_object

    def place(self, thing):
        """Moves, turns and mirrors an object, and makes its axes unequal."""
        thing.location, thing.scale = (0.31, -2.7, 1.3), (1.1, -0.9, 1.3)
        thing.rotation_euler.z += 0.37
        bpy.context.view_layer.update()

    def run_operator(self, name):
        """Presses a button, as an undo step of its own. Returns False if it says that it was cancelled."""
        return getattr(bpy.ops.bounding_proxies, name)("EXEC_DEFAULT", True) == {"FINISHED"}

    def refused(self, name):
        """Presses a button that must fail, and returns what it reports."""
        with self.assertRaises(RuntimeError) as caught:
            self.run_operator(name)
        return str(caught.exception)

    def kind(self, kind):
        return sorted((o for o in bpy.data.objects if o.get("bp_kind") == kind), key=lambda o: o.name)

    def assert_around(self, proxies, source, count=300):
        """Asks rays of Blender, not the tools, whether points of the source, as Blender shows it, lie within the proxies."""
        trees = [(BVHTree.FromObject(o, bpy.context.evaluated_depsgraph_get()), o.matrix_world.inverted()) for o in proxies]
        points = shown_points(source)
        for point in points[::max(1, len(points) // count)]:
            self.assertTrue(any(is_inside(tree, inverse @ point) for tree, inverse in trees), f"{point} is outside")


def shown_points(thing):
    """The vertices of an object with its modifiers, in the world."""
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    points = [evaluated.matrix_world @ vertex.co for vertex in mesh.vertices]
    evaluated.to_mesh_clear()
    return points


def is_inside(tree, point):
    """Counts what rays cross. Two of three directions decide, for a ray may meet an edge."""
    votes = 0
    for direction in (Vector((0.12, 0.34, 0.93)), Vector((-0.8, 0.3, 0.52)), Vector((0.3, -0.9, 0.31))):
        crossed, begin = 0, point
        while crossed < 1000:
            hit = tree.ray_cast(begin, direction)[0]
            if hit is None:
                break
            crossed, begin = crossed + 1, hit + direction * 1e-5
        votes += crossed % 2
    return votes >= 2


def reopen(folder):
    """Saves the file and opens it again."""
    path = os.path.join(folder, "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=path)


def main(*cases):
    """Runs the tests, and ends Blender with their result."""
    suite = unittest.TestSuite(unittest.defaultTestLoader.loadTestsFromTestCase(case) for case in cases)
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(suite)
    sys.stdout.flush()
    if not result.wasSuccessful() or result.testsRun == 0:
        sys.exit(1)
