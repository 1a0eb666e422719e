"""Cages: bound, moved, saved and opened again; objects far from the origin."""
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # noqa: E402
from support import AddonTest, main, reopen, shown_points  # noqa: E402


class Cages(AddonTest):
    def test_a_figure_follows_its_cage(self):
        figure = self.load("figure")
        figure.modifiers.new("smooth", "SUBSURF").levels = 1
        before = shown_points(figure)
        self.settings.cage_faces, self.settings.check_after = 600, True
        self.assertTrue(self.run_operator("cage"))
        [cage] = self.kind("CAGE")
        self.assertEqual(cage["bp_proof"], "holds")
        self.assertGreater(sum(len(face.vertices) == 4 for face in cage.data.polygons), 0.9 * len(cage.data.polygons))
        modifier = figure.modifiers["Proxy cage"]
        self.assertTrue(modifier.is_bound and modifier.object == cage)
        self.assert_around([cage], figure)
        self.assertLess(max((a - b).length for a, b in zip(before, shown_points(figure))), 1e-4)
        with tempfile.TemporaryDirectory() as folder:
            reopen(folder)
        figure, [cage] = bpy.data.objects["figure"], self.kind("CAGE")
        self.assertTrue(figure.modifiers["Proxy cage"].is_bound)
        for vertex in cage.data.vertices:  # taller, and to the side
            vertex.co.x += 0.5 * vertex.co.z
            vertex.co.z *= 1.5
        cage.data.update()
        bpy.context.view_layer.update()
        moved = shown_points(figure)
        for a, b in zip(before[::50], moved[::50]):
            self.assertAlmostEqual(b.x, a.x + 0.5 * a.z, delta=0.06)
            self.assertAlmostEqual(b.z, 1.5 * a.z, delta=0.06)
        self.assert_around([cage], figure)

    def test_a_new_cage_is_that_of_the_figure_at_rest(self):
        figure = self.load("figure")
        self.settings.cage_faces = 400
        self.assertTrue(self.run_operator("cage"))
        rest = [tuple(v.co) for v in self.kind("CAGE")[0].data.vertices]
        for vertex in self.kind("CAGE")[0].data.vertices:
            vertex.co *= 2
        bpy.context.view_layer.update()
        self.assertTrue(self.run_operator("cage"))
        [cage] = self.kind("CAGE")
        self.assertEqual([tuple(v.co) for v in cage.data.vertices], rest)
        self.assertEqual([(m.name, m.object, m.is_bound) for m in figure.modifiers], [("Proxy cage", cage, True)])

    def test_without_bind_there_is_no_modifier(self):
        figure = self.load("figure")
        self.settings.bind, self.settings.cage_faces = False, 400
        self.assertTrue(self.run_operator("cage"))
        self.assertEqual(len(figure.modifiers), 0)
        self.settings.bind = True
        self.assertTrue(self.run_operator("cage"))
        self.assertEqual(len(figure.modifiers), 1)
        self.settings.bind = False
        self.assertTrue(self.run_operator("cage"))
        self.assertEqual(len(figure.modifiers), 0)

    def test_a_larger_margin_holds_and_symmetry_is_that_of_blender(self):
        self.load("figure")
        self.settings.margin, self.settings.symmetry, self.settings.check_after = 3, "x", True
        self.settings.cage_faces = 400
        self.assertTrue(self.run_operator("cage"))
        [cage] = self.kind("CAGE")
        self.assertEqual(cage["bp_proof"], "holds")
        self.assertIn("--symmetry x", cage["bp_command"])
        places = {tuple(v.co) for v in cage.data.vertices}
        middle = (min(p[0] for p in places) + max(p[0] for p in places)) / 2
        mirrored = [min(abs(2 * middle - p[0] - q[0]) + abs(p[1] - q[1]) + abs(p[2] - q[2]) for q in places) for p in places]
        self.assertLess(max(mirrored), 1e-5)

    def test_far_from_the_origin_nothing_is_rounded(self):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=3)
        ball = bpy.context.active_object
        ball.name = "ball"
        ball.location = (84903.7, -447611.3, 12)
        bpy.context.view_layer.update()
        self.settings.check_after = True
        self.settings.cage_faces = 200
        self.assertTrue(self.run_operator("cage") and self.run_operator("collision"))
        for proxy in (self.kind("CAGE")[0], self.kind("COLLISION")[0]):
            self.assertEqual(proxy["bp_proof"], "holds")
            self.assertLess((proxy.location - ball.location).length, 1000)
            self.assertLess(max(v.co.length for v in proxy.data.vertices), 1000)
        self.assertTrue(ball.modifiers["Proxy cage"].is_bound)


main(Cages)
