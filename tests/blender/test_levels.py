"""Levels with textures and colours, and occluders behind glass."""
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import bpy  # noqa: E402
from support import AddonTest, main, reopen  # noqa: E402


def images_of(thing):
    """The images that the material of an object shows."""
    return [node.image for slot in thing.material_slots for node in slot.material.node_tree.nodes if node.type == "TEX_IMAGE"]


class Levels(AddonTest):
    def test_levels_of_textured_objects_have_textures(self):
        town = self.load("town/town")
        self.settings.level_faces, self.settings.check_after = "300,80", True
        self.settings.resolution = 160
        self.assertTrue(self.run_operator("levels"))
        levels = self.kind("LEVELS")
        self.assertEqual([o.name for o in levels], ["town_LOD0", "town_LOD1"])
        self.assertEqual([o["bp_proof"] for o in levels], ["holds", "holds"])
        self.assertEqual([o.hide_get() for o in levels], [False, True])
        self.assert_around(levels[:1], town)
        with tempfile.TemporaryDirectory() as folder:
            reopen(folder)
        fine = bpy.data.objects["town_LOD0"]
        [image] = images_of(fine)
        self.assertTrue(image.packed_file and image.size[0] >= 128, list(image.size))
        pixels = list(image.pixels)  # a copy: each access to the image's own would read all of them
        self.assertGreater(len({tuple(round(c, 1) for c in pixels[i:i + 3]) for i in range(0, len(pixels), 4000)}), 10)
        places = [tuple(entry.uv) for entry in fine.data.uv_layers[0].data]
        self.assertGreater(max(u for u, _ in places) - min(u for u, _ in places), 0.5)
        self.assertTrue(all(-0.01 <= c <= 1.01 for place in places for c in place))

    def test_a_second_run_leaves_no_images_and_materials_behind(self):
        self.load("town/town")
        self.settings.level_faces = "200"
        for _ in range(2):
            self.assertTrue(self.run_operator("levels"))
        self.assertEqual(len(self.kind("LEVELS")), len([m for m in bpy.data.materials if m.name.startswith("town_LOD")]))
        self.assertEqual([i.name for i in bpy.data.images if i.users == 0], [])

    def test_levels_show_the_colours_of_materials(self):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=2)
        ball = bpy.context.active_object
        material = bpy.data.materials.new("red")
        material.use_nodes = True
        material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.8, 0.1, 0.05, 1)
        ball.data.materials.append(material)
        self.settings.level_faces, self.settings.level_mode = "300", "fit"
        self.settings.check_after = True
        self.assertTrue(self.run_operator("levels"))
        level = self.kind("LEVELS")[0]
        self.assertEqual(level["bp_proof"], "holds")  # as a mesh: a fit need not enclose
        colors = [tuple(entry.color) for entry in level.data.color_attributes[0].data]
        for color in colors:
            for shown, wanted in zip(color, (0.8, 0.1, 0.05)):
                self.assertAlmostEqual(shown, wanted, delta=0.02)

    def test_colours_of_vertices_count_where_the_material_shows_them(self):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=2)
        ball = bpy.context.active_object
        colors = ball.data.color_attributes.new("paint", "FLOAT_COLOR", "POINT")
        for vertex, entry in zip(ball.data.vertices, colors.data):
            entry.color = (0, 0, 1, 1) if vertex.co.x > 0 else (0, 1, 0, 1)
        material = bpy.data.materials.new("painted")
        material.use_nodes = True
        nodes = material.node_tree.nodes
        node = nodes.new("ShaderNodeVertexColor")
        node.layer_name = "paint"
        material.node_tree.links.new(node.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
        ball.data.materials.append(material)
        self.settings.level_faces = "500"
        self.assertTrue(self.run_operator("levels"))
        mesh = self.kind("LEVELS")[0].data
        for loop, entry in zip(mesh.loops, mesh.color_attributes[0].data):
            x = mesh.vertices[loop.vertex_index].co.x
            if abs(x) > 1:
                self.assertGreater(entry.color[2 if x > 0 else 1], 0.9, (x, tuple(entry.color)))


    def test_a_mapping_and_an_image_that_is_no_file_reach_the_level(self):
        """An image of four colours, of which the mapping shows the third only; its green channel is the roughness."""
        ball = self.ball("ball")
        image = bpy.data.images.new("stripes", 4, 1)
        image.pixels = [1, 0, 0, 1, 0, 1, 0, 1, 0, 0.2, 1, 1, 1, 1, 1, 1]
        ball.data.materials.append(bpy.data.materials.new("mapped"))
        material = ball.data.materials[0]
        material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        texture, mapping, places, split = map(nodes.new, ("ShaderNodeTexImage", "ShaderNodeMapping", "ShaderNodeTexCoord", "ShaderNodeSeparateColor"))
        texture.image = image
        mapping.inputs["Location"].default_value = (0.625, 0.5, 0)
        mapping.inputs["Scale"].default_value = (0.001, 0.001, 1)
        links.new(places.outputs["UV"], mapping.inputs["Vector"])
        links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
        links.new(texture.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
        links.new(texture.outputs["Color"], split.inputs[0])
        links.new(split.outputs["Green"], nodes["Principled BSDF"].inputs["Roughness"])
        self.settings.level_faces, self.settings.appearance = "200", "full"
        self.assertTrue(self.run_operator("levels"))
        level = self.kind("LEVELS")[0]
        made = {image.name.rsplit("_", 1)[1].split(".")[0]: image for image in images_of(level)}
        pixels = list(made["color"].pixels)
        shown = [pixels[i:i + 3] for i in range(0, len(pixels), 4)]
        blue = [c for c in shown if c[2] > 0.85 and c[0] < 0.1 and abs(c[1] - 0.2) < 0.1]
        self.assertGreater(len(blue), 0.5 * len(shown))
        self.assertFalse([c for c in shown if c[0] > 0.5])
        shader = next(n for n in level.data.materials[0].node_tree.nodes if n.type == "BSDF_PRINCIPLED")
        rough = shader.inputs["Roughness"]
        value = list(made["rough"].pixels)[1] if rough.is_linked else rough.default_value
        self.assertAlmostEqual(value, 0.2, delta=0.05)


class Occluders(AddonTest):
    def test_an_occluder_lies_within_what_the_house_hides(self):
        house = self.load("house")
        self.settings.scale_kind, self.settings.scale_percent, self.settings.check_after = "PERCENT", 4, True
        self.assertTrue(self.run_operator("occluder"))
        [occluder] = self.kind("OCCLUDER")
        self.assertTrue(occluder["bp_proof"].startswith("holds, if gaps narrower than"), occluder["bp_proof"])
        low, high = ([f((house.matrix_world @ v.co)[i] for v in house.data.vertices) for i in range(3)] for f in (min, max))
        for vertex in occluder.data.vertices:
            self.assertTrue(all(a < c < b for a, c, b in zip(low, vertex.co, high)), vertex.co)
        self.assertTrue(occluder.hide_render)

    def test_glass_is_no_wall(self):
        """A closed box hides its inside; of glass it hides nothing."""
        bpy.ops.mesh.primitive_cube_add(size=4)
        box = bpy.context.active_object
        box.data.materials.append(bpy.data.materials.new("pane"))
        pane = box.data.materials[0]
        pane.use_nodes = True
        self.assertTrue(self.run_operator("occluder"))
        inputs = pane.node_tree.nodes["Principled BSDF"].inputs
        inputs["Transmission" if "Transmission" in inputs else "Transmission Weight"].default_value = 1
        self.assertIn("no triangles", self.refused("occluder"))


main(Levels, Occluders)
