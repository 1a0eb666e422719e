"""The add-on in a window: Blender stays usable while a tool runs, Esc ends it, progress stands in the status bar, and undo is one step.
Started by run.sh under a virtual screen, with Blender's option to simulate events. Ends Blender with 0 if all is as it should be."""
import os
import sys
import time
import traceback
from pathlib import Path

import bpy

ADDON = "bounding_proxies_addon"
bpy.context.preferences.view.show_splash = False
bpy.ops.preferences.addon_enable(module=ADDON)


def steps():
    """What happens, as a generator: each yield lets Blender's main loop run for so many seconds."""
    window = bpy.context.window_manager.windows[0]
    area = next(a for a in window.screen.areas if a.type == "VIEW_3D")
    view = dict(window=window, area=area, region=next(r for r in area.regions if r.type == "WINDOW"))
    operators = sys.modules[f"{ADDON}.operators"]
    said = []
    # The status bar cannot be read back, so what is written to it is caught on the way.
    advance = operators.Running.modal

    def modal(operator, context, event):
        if event.type == "TIMER":
            said.append(operator._job.progress[0])
        return advance(operator, context, event)

    operators.Running.modal = modal
    with bpy.context.temp_override(**view):
        for thing in list(bpy.data.objects):
            bpy.data.objects.remove(thing)
        bpy.ops.wm.obj_import(filepath=str(Path(os.environ["BP_SCENES"]) / "figure.obj"))
        bpy.context.view_layer.objects.active = bpy.context.selected_objects[0]
        settings = bpy.context.scene.bounding_proxies
        settings.grid_kind, settings.resolution, settings.level_faces = "RESOLUTION", 700, "20000,5000"
        settings.precision = 3
        bpy.ops.ed.undo_push(message="imported")
        assert bpy.ops.bounding_proxies.levels("INVOKE_DEFAULT", True) == {"RUNNING_MODAL"}
        assert not bpy.ops.bounding_proxies.cage.poll(), "two jobs at once"
    begin = time.monotonic()
    while len(said) < 3:
        assert operators.running, "the job ended before it could be cancelled"
        yield 0.05
    assert any(name.startswith("bplod: ") for name in said), said
    folder = operators.running[0].folder
    for value in ("PRESS", "RELEASE"):
        window.event_simulate(type="ESC", value=value, x=300, y=300)
    while operators.running:
        yield 0.05
    print("cancelled after", round(time.monotonic() - begin, 1), "seconds;", sorted(set(said)))
    assert [o.name for o in bpy.data.objects] == ["figure"] and not folder.exists()

    settings = bpy.context.scene.bounding_proxies
    settings.resolution, settings.cage_faces = 96, 300
    with bpy.context.temp_override(**view):
        assert bpy.ops.bounding_proxies.cage("INVOKE_DEFAULT", True) == {"RUNNING_MODAL"}
    while operators.running:
        yield 0.05
    yield 0.2
    assert bpy.data.objects["figure_cage"]["bp_proof"] == "holds"
    assert bpy.data.objects["figure"].modifiers["Proxy cage"].is_bound
    with bpy.context.temp_override(**view):
        bpy.ops.ed.undo()
    assert [o.name for o in bpy.data.objects] == ["figure"] and not bpy.data.objects["figure"].modifiers
    assert "figure proxies" not in bpy.data.collections
    with bpy.context.temp_override(**view):
        bpy.ops.ed.redo()
    assert bpy.data.objects["figure"].modifiers["Proxy cage"].is_bound


running_steps = steps()


def tick():
    try:
        return next(running_steps)
    except StopIteration:
        status = 0
    except BaseException:
        traceback.print_exc(file=sys.stdout)
        status = 1
    sys.stdout.flush()
    os._exit(status)


bpy.app.timers.register(tick, first_interval=0.5)
