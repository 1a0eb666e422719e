"""Makes the pictures of docs/guides/blender.md, by the add-on itself.
    blender -b --factory-startup --python-exit-code 1 -P docs/blender_gallery.py -- SCENES OUT         what the add-on makes
    blender --factory-startup --enable-event-simulate -p 0 0 1120 720 -P docs/blender_gallery.py -- SCENES OUT      its panel, in a window
SCENES: a folder with the files of samples/scenes.py, and in its folder "town" those of samples/town.py with 16 houses. The add-on is installed, and the tools are
on PATH."""
import math
import os
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Vector

ADDON = "bounding_proxies_addon"
SCENES, OUT = map(Path, sys.argv[sys.argv.index("--") + 1:])
VIEW = Vector((0.75, -1, 0.45)).normalized()


def begin(name):
    """Begins with one scene, selected."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module=ADDON)
    return load(name)


def load(name):
    bpy.ops.wm.obj_import(filepath=str(SCENES / f"{name}.obj"))
    thing = bpy.context.selected_objects[0]
    bpy.context.view_layer.objects.active = thing
    return thing


def wires(thing, width, color):
    """A copy of a proxy, as bars along its edges."""
    copy = bpy.data.objects.new(thing.name + " wires", thing.data.copy())
    modifier = copy.modifiers.new("wires", "WIREFRAME")
    modifier.thickness, modifier.use_even_offset = width, False
    copy.color = color
    bpy.context.scene.collection.objects.link(copy)
    return copy


def draw(things, size, color_type, zoom=1.0, view=VIEW, around=None):
    """Renders some objects alone, and returns the pixels."""
    scene = bpy.context.scene
    for thing in bpy.data.objects:
        thing.hide_render = thing not in things
    corners = [o.matrix_world @ Vector(c) for o in around or things for c in o.bound_box]
    low, high = (Vector(f(c[i] for c in corners) for i in range(3)) for f in (min, max))
    camera = scene.camera or bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    if not scene.camera:
        scene.collection.objects.link(camera)
        scene.camera = camera
    camera.hide_render = False
    camera.data.type, camera.data.ortho_scale = "ORTHO", (high - low).length / zoom
    camera.data.clip_end = 100 * (high - low).length
    camera.matrix_world = Matrix.Translation((low + high) / 2 + view * (high - low).length * 2) @ view.to_track_quat("Z", "Y").to_matrix().to_4x4()
    scene.render.engine = "BLENDER_WORKBENCH"
    shading = scene.display.shading
    shading.light, shading.color_type, shading.show_cavity, shading.show_object_outline = "STUDIO", color_type, True, False
    scene.display.render_aa = "8"
    scene.view_settings.view_transform = "Standard"
    scene.world = scene.world or bpy.data.worlds.new("world")
    scene.world.color = (0.9, 0.9, 0.9)
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = *size, 100
    scene.render.film_transparent = False
    scene.render.filepath = str(OUT / "part.png")
    bpy.ops.render.render(write_still=True)
    return read(scene.render.filepath)


def save(name, pictures):
    """Writes pictures side by side, with fewer colours, so that the file is small."""
    pixels = np.round(np.concatenate(pictures, axis=1)[..., :3] * 31) / 31
    pixels = np.concatenate([pixels, np.ones_like(pixels[..., :1])], axis=2)
    image = bpy.data.images.new(name, pixels.shape[1], pixels.shape[0], alpha=False)
    image.pixels.foreach_set(np.ascontiguousarray(pixels, np.float32).ravel())
    image.filepath_raw, image.file_format = str(OUT / f"{name}.png"), "PNG"
    image.save()


def read(path):
    """Returns the pixels of a picture, and removes it."""
    image = bpy.data.images.load(str(path))
    pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(image.size[1], image.size[0], 4)
    bpy.data.images.remove(image)
    os.remove(path)
    return pixels


def kind(name):
    return sorted((o for o in bpy.data.objects if o.get("bp_kind") == name), key=lambda o: o.name)


def collision():
    truck = begin("truck")
    bpy.ops.bounding_proxies.collision()
    bpy.ops.bounding_proxies.hulls()
    [body] = kind("COLLISION")
    hulls = kind("HULLS")
    body.color = (0.55, 0.65, 0.8, 1)
    bars = wires(body, 0.025, (0.1, 0.2, 0.35, 1))
    size = (320, 215)
    save("collision", [draw([truck], size, "MATERIAL", 1.08), draw([body, bars], size, "OBJECT", 1.08, around=[truck]),
                                     draw(hulls, size, "RANDOM", 1.08, around=[truck])])


def cage():
    figure = begin("figure")
    bpy.ops.bounding_proxies.cage()
    [cage] = kind("CAGE")
    size, zoom = (290, 320), 1.25
    view = Vector((0.8, -1, 0.25)).normalized()
    figure.color = (0.45, 0.6, 0.35, 1)
    bars = wires(cage, 0.012, (0.1, 0.2, 0.35, 1))
    pictures = [draw([figure, bars], size, "OBJECT", zoom, view, [cage])]
    for vertex in cage.data.vertices:  # leans to the side, above the hips
        x, y, z = vertex.co
        angle = 0.55 * max(0, z - 0.9)
        vertex.co = (x * math.cos(angle) + 0.8 * max(0, z - 0.9) * math.sin(angle), y, z - x * math.sin(angle))
    bpy.data.objects.remove(bars)
    bars = wires(cage, 0.012, (0.1, 0.2, 0.35, 1))
    bpy.context.view_layer.update()
    pictures += [draw([figure, bars], size, "OBJECT", zoom, view, [cage]), draw([figure], size, "OBJECT", zoom, view, [cage])]
    save("cage", pictures)


def levels():
    town = begin("town/town")
    bpy.context.scene.bounding_proxies.level_faces = "1500,250"
    bpy.ops.bounding_proxies.levels()
    size, view = (300, 210), Vector((0.6, -1, 0.7)).normalized()
    for level in kind("LEVELS"):
        level.hide_set(False)
    save("levels", [draw([thing], size, "TEXTURE", 1.35, view, [town]) for thing in [town] + kind("LEVELS")])


def panel():
    """Steps of Blender's main loop, as a generator: makes a cage in the window, opens the tab and takes a picture."""
    window = bpy.context.window_manager.windows[0]
    area = next(a for a in window.screen.areas if a.type == "VIEW_3D")
    view = dict(window=window, area=area, region=next(r for r in area.regions if r.type == "WINDOW"))
    with bpy.context.temp_override(**view):
        for thing in list(bpy.data.objects):
            bpy.data.objects.remove(thing)
        load("figure")
        bpy.context.scene.bounding_proxies.cage_faces = 700
        area.spaces.active.show_region_ui = True
        area.spaces.active.overlay.show_floor = False
        area.spaces.active.overlay.show_axis_x = area.spaces.active.overlay.show_axis_y = False
        bpy.ops.view3d.view_selected()
        bpy.ops.bounding_proxies.cage("EXEC_DEFAULT")
    yield 1
    sidebar = next(r for r in area.regions if r.type == "UI")
    for event, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        window.event_simulate(type=event, value=value, x=sidebar.x + sidebar.width - 8, y=sidebar.y + sidebar.height - 165)
        yield 0.3
    yield 0.7
    path = OUT / "window.png"
    bpy.ops.screen.screenshot(filepath=str(path))
    save("panel", [read(path)[area.y:area.y + area.height, area.x:area.x + area.width]])


def tick():
    try:
        return next(running)
    except StopIteration:
        os._exit(0)


OUT.mkdir(parents=True, exist_ok=True)
if bpy.app.background:
    collision()
    cage()
    levels()
else:
    bpy.context.preferences.view.show_splash = False
    bpy.ops.preferences.addon_enable(module=ADDON)
    running = panel()
    bpy.app.timers.register(tick, first_interval=0.5)
