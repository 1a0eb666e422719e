"""A GLB as Blender shows it:  blender -b --factory-startup --python blender.py -- FILE.glb OUT.png
Prints "greys N": the number of grey values of the pixels that show the model."""
import sys

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Blender 3.4 with numpy 1.24, as in Debian 12
path, out = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=path)
meshes = [o for o in bpy.context.scene.objects if o.type == "MESH"]
corners = [o.matrix_world @ Vector(c) for o in meshes for c in o.bound_box]
low, high = (Vector(f(c[i] for c in corners) for i in range(3)) for f in (min, max))
middle, size = (low + high) / 2, (high - low).length
scene = bpy.context.scene
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.clip_end = 100 * size
camera.location = middle + Vector((0.8, -1.1, 0.6)) * size
camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy = 4
sun.rotation_euler = (0.5, 0.3, 0.8)
for thing in (camera, sun):
    scene.collection.objects.link(thing)
scene.camera = camera
scene.world = bpy.data.worlds.new("world")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.3, 0.35, 0.45, 1)
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 16, False
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 400, 300, 100
scene.render.film_transparent = True
scene.render.image_settings.color_mode = "RGBA"
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
pixels = list(bpy.data.images.load(out).pixels)
shown = [pixels[i:i + 3] for i in range(0, len(pixels), 4) if pixels[i + 3] > 0.99]
print("greys", len({round(255 * sum(p) / 3) for p in shown}))
