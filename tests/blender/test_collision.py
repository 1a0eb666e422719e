"""Collision bodies and convex hulls: where they lie, their names, undo, files, and a second run."""
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # noqa: E402
from support import AddonTest, main, reopen  # noqa: E402


class Collision(AddonTest):
    def test_a_body_lies_around_an_object_that_is_turned_and_mirrored(self):
        truck = self.load("truck")
        self.place(truck)
        self.settings.check_after = True
        self.assertTrue(self.run_operator("collision"))
        body = bpy.data.objects["truck_collision"]
        self.assert_around([body], truck)
        self.assertEqual(body["bp_proof"], "holds")
        self.assertEqual([c.name for c in body.users_collection], ["truck proxies"])
        self.assertEqual([list(row) for row in body.matrix_world], [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        self.assertEqual(list(body["bp_sources"].values()), [truck])
        self.assertLessEqual(len(body.data.polygons), 500)
        self.assertEqual(body["bp_faces"], len(body.data.polygons))
        self.assertIn("--profile collision --faces 500", body["bp_command"])
        self.assertEqual(body["bp_contract"], "encloses")
        self.assertTrue(body["bp_version"])
        self.assertEqual([o for o in bpy.context.selected_objects], [truck])

    def test_hulls_have_the_names_of_unreal_and_enclose_together(self):
        truck = self.load("truck")
        self.place(truck)
        self.settings.hulls, self.settings.check_after = 12, True
        self.assertTrue(self.run_operator("hulls"))
        hulls = self.kind("HULLS")
        self.assertEqual([o.name for o in hulls], [f"UCX_truck_{i:02d}" for i in range(len(hulls))])
        self.assertGreater(len(hulls), 1)
        self.assertTrue(all(o["bp_proof"] == "holds" for o in hulls))
        self.assert_around(hulls, truck)
        hulls[0].location.z += 5
        bpy.context.view_layer.update()
        bpy.ops.bounding_proxies.check()
        self.assertTrue(hulls[0]["bp_proof"].startswith("does not hold"), hulls[0]["bp_proof"])

    def test_a_second_run_takes_the_place_of_the_first(self):
        ball = self.ball("truck")
        self.settings.engine = "GODOT"
        self.assertTrue(self.run_operator("collision") and self.run_operator("hulls"))
        ball.name = "lorry"
        self.settings.collision_faces = 200
        self.assertTrue(self.run_operator("collision"))
        self.assertEqual([o.name for o in self.kind("COLLISION")], ["lorry-colonly"])
        self.assertLessEqual(self.kind("COLLISION")[0]["bp_faces"], 200)
        self.assertTrue(self.kind("HULLS"))
        self.assertEqual([m.name for m in bpy.data.meshes if m.users == 0], [])
        self.assertEqual([c.name for c in bpy.data.collections], ["models", "truck proxies"])

    def test_modifiers_and_instances_count(self):
        bpy.ops.mesh.primitive_cube_add(size=1)
        cube = bpy.context.active_object
        cube.name = "row"
        cube.modifiers.new("array", "ARRAY").count = 4
        bpy.ops.object.collection_instance_add(collection=self.far_cube().name, location=(0, 3, 0))
        instance = bpy.context.active_object
        cube.select_set(True)
        bpy.context.view_layer.objects.active = cube
        self.assertTrue(self.run_operator("collision"))
        body = self.kind("COLLISION")[0]
        self.assert_around([body], cube)
        self.assertEqual(set(body["bp_sources"].values()), {cube, instance})
        self.assertGreater(max(v.co.y for v in body.data.vertices), 3.5)
        self.assertGreater(max(v.co.x for v in body.data.vertices), 3.5)

    def far_cube(self):
        """A collection with a cube that the scene shows by its instance only."""
        collection = bpy.data.collections.new("cubes")
        collection.objects.link(bpy.data.objects.new("inner", bpy.data.objects["row"].data))
        return collection

    def test_undo_is_one_step(self):
        self.ball("truck")
        bpy.ops.ed.undo_push(message="imported")
        self.assertTrue(self.run_operator("collision"))
        self.assertTrue(self.kind("COLLISION"))
        bpy.ops.ed.undo()
        self.assertEqual([o.name for o in bpy.data.objects], ["truck"])
        self.assertNotIn("truck proxies", bpy.data.collections)
        bpy.ops.ed.redo()
        self.assertEqual([o.name for o in self.kind("COLLISION")], ["truck_collision"])

    def test_a_preset_keeps_all_settings(self):
        self.settings.margin, self.settings.level_faces, self.settings.scale_kind = 2.5, "10%", "LENGTH"
        self.assertEqual(bpy.ops.bounding_proxies.preset_add(name="mine"), {"FINISHED"})
        self.settings.margin, self.settings.level_faces, self.settings.scale_kind = 1, "", "AUTO"
        [path] = Path(bpy.utils.user_resource("SCRIPTS", path="presets/bounding_proxies")).glob("*.py")
        bpy.ops.script.execute_preset(filepath=str(path), menu_idname="BOUNDING_PROXIES_PT_presets")
        self.assertEqual((self.settings.margin, self.settings.level_faces, self.settings.scale_kind), (2.5, "10%", "LENGTH"))

    def test_a_saved_file_keeps_what_is_known(self):
        ball = self.ball("truck")
        self.settings.collision_faces = 300
        self.assertTrue(self.run_operator("collision"))
        ball.name = "lorry"
        with tempfile.TemporaryDirectory() as folder:
            reopen(folder)
        body = bpy.data.objects["truck_collision"]
        self.assertEqual([o.name for o in body["bp_sources"].values()], ["lorry"])
        self.assertEqual(bpy.context.scene.bounding_proxies.collision_faces, 300)
        body.select_set(True)
        self.assertTrue(self.run_operator("check"))
        self.assertEqual(body["bp_proof"], "holds")


main(Collision)
