"""The buttons of the panel. Each is a chain of steps: Blender's data is read and written here, and what takes time is a job beside."""
from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import Generator

import bpy

from . import commands, results
from .gather import at_rest, gather, shown
from .jobs import Job, ToolError
from .mesh_read import read_glb, read_obj
from .mesh_write import Scene, write_obj, write_ply
from .settings import preferences

POLL_SECONDS = 0.1
# Files of the profile collision: the body, and the hulls.
CHOSEN_FILES = {"COLLISION": "_godot.glb", "HULLS": "_unreal.glb", "OCCLUDER": "_occluder.glb", "LEVELS": ".glb", "CAGE": "_cage.obj"}
running: list[Job] = []

Steps = Generator[Job, Job, None]


class Running:
    """Drives an operator through its steps: by a timer, so that Blender stays usable, or waiting, where a script calls it."""

    bl_options = {"REGISTER", "UNDO"}
    changed = False  # whether the scene is not as it was before

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if running:
            cls.poll_message_set("Another job runs; Esc ends it")
        return not running and context.mode == "OBJECT"

    def steps(self, context: bpy.types.Context) -> Steps:
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        if not self._begin(context):
            return {"CANCELLED"}
        while True:
            self._job.wait()
            answer = self._advance(context)
            if answer != {"RUNNING_MODAL"}:
                return answer

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if bpy.app.background:
            return self.execute(context)
        if not self._begin(context):
            return {"CANCELLED"}
        self._timer = context.window_manager.event_timer_add(POLL_SECONDS, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "ESC" and event.value == "PRESS":
            self._job.cancel()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        name, done, total = self._job.progress
        share = f" {100 * done // total} %" if total else f" {done}" if done else ""
        context.workspace.status_text_set(f"{self.bl_label}: {name}{share}    Esc: cancel")
        if not self._job.done:
            return {"PASS_THROUGH"}
        answer = {"CANCELLED"}
        try:
            answer = self._advance(context)
        finally:
            if answer != {"RUNNING_MODAL"}:
                context.window_manager.event_timer_remove(self._timer)
                context.workspace.status_text_set(None)
        return answer

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender ends the operator itself: another file is opened, or Blender is closed."""
        self._job.cancel()
        self._job.wait()
        self._end()

    def _begin(self, context: bpy.types.Context) -> bool:
        self._steps = self.steps(context)
        try:
            self._start(next(self._steps))
        except (ToolError, StopIteration) as e:
            self.report({"ERROR"}, str(e) or "Nothing to do")
            return False
        return True

    def _start(self, job: Job) -> None:
        self._job = job
        running.append(job)
        job.start()

    def _end(self) -> None:
        running.remove(self._job)
        self._job.close()

    def _advance(self, context: bpy.types.Context) -> set[str]:
        """Takes what a job has found, and starts the next one."""
        job = self._job
        try:
            if job.cancelled or job.error:
                self.report({"WARNING"} if job.cancelled else {"ERROR"}, "Cancelled" if job.cancelled else job.error)
                return {"FINISHED"} if self.changed else {"CANCELLED"}
            following = self._steps.send(job)
        except StopIteration:
            return {"FINISHED"}
        except ToolError as e:
            self.report({"ERROR"}, str(e))
            return {"FINISHED"} if self.changed else {"CANCELLED"}
        finally:
            self._end()
        self._start(following)
        return {"RUNNING_MODAL"}


class Making(Running):
    """Makes a proxy of the selected objects, and proves it as it lies in the scene."""

    kind = ""

    def steps(self, context: bpy.types.Context) -> Steps:
        sources = [thing for thing in context.selected_objects if not results.is_proxy(thing)]
        if not sources:
            raise ToolError("Select the objects to make a proxy of")
        name = (context.active_object if context.active_object in sources else sources[0]).name
        names = [thing.name for thing in sources]
        settings, tools = context.scene.bounding_proxies, preferences(context)
        choices = settings.choices(self.kind, tools)
        path = commands.tool_path("bplod", tools.folder)
        with at_rest(context, sources if self.kind == "CAGE" else [], results.is_cage):
            scene = gather(context, sources, commands.has_looks(self.kind), choices.appearance == "full")
        if not scene.triangles:
            raise ToolError(f"{name} has no faces")
        job = yield Job(lambda job: make(job, choices, path, commands.safe_name(name), scene))

        result: results.Result = job.result
        sources = [thing for thing in map(bpy.data.objects.get, names) if thing is not None]
        if len(sources) < len(names):
            raise ToolError("An object was deleted or renamed meanwhile; nothing was changed")
        self.changed = True
        made = results.place(context, result, name, sources, settings.engine)
        if self.kind == "CAGE" and not settings.bind:
            results.unbind(sources)
        elif self.kind == "CAGE":
            failed = results.bind(context, made[0], sources, settings.precision)
            if failed:
                self.report({"WARNING"}, f"Not bound to the cage: {', '.join(failed)}; only meshes of this file can be")
        for note in result.notes:
            self.report({"INFO"}, note)
        faces = [o["bp_faces"] for o in made] if self.kind == "LEVELS" else [sum(o["bp_faces"] for o in made)]
        self.report({"INFO"}, f"{results.TITLES[self.kind]} of {name}: {', '.join(str(n) for n in faces)} faces")
        if settings.check_after:
            yield from prove(self, context, made)


class Check(Running, bpy.types.Operator):
    """Proves the selected proxies, or all proxies of the selected objects, as they lie in the scene"""

    bl_idname = "bounding_proxies.check"
    bl_label = "Check"

    def steps(self, context: bpy.types.Context) -> Steps:
        chosen = context.selected_objects
        proxies = [o for o in chosen if results.is_proxy(o)] or results.proxies_of(chosen)
        if not proxies:
            raise ToolError("Select a proxy, or objects that have proxies")
        yield from prove(self, context, proxies)


def prove(operator: Running, context: bpy.types.Context, proxies: list[bpy.types.Object]) -> Steps:
    """Runs bpcheck on proxies: hulls together, other proxies one by one."""
    path = commands.tool_path("bpcheck", preferences(context).folder)
    choices = context.scene.bounding_proxies.choices("CHECK", preferences(context))
    groups: dict[tuple, list[bpy.types.Object]] = {}
    for proxy in proxies:
        sources = tuple(sorted(source.name for source in results.sources_of(proxy)))
        groups.setdefault((sources, proxy[results.KIND], "" if proxy[results.KIND] == "HULLS" else proxy.name), []).append(proxy)
    for names, title in [([o.name for o in group], _group_title(group)) for group in groups.values()]:
        group = [bpy.data.objects[name] for name in names]
        sources = results.sources_of(group[0])
        command = commands.check_command(group[0][results.KIND], group[0].get("bp_mode", ""), results.margin_of(group[0]))
        if not sources and len(command) > 2:
            raise ToolError(f"{title}: the objects that it was made of are gone")
        with shown(context, sources + group):
            unseen = [thing.name for thing in sources + group if not thing.visible_get()]
            if unseen:  # Blender does not evaluate it, and a proof without it would claim too much
                raise ToolError(f"{unseen[0]} is hidden by its collection, or not in this view layer; show it first")
            scene, proxy = gather(context, sources, commands.has_looks(group[0][results.KIND])), gather(context, group)
        proxy.comments = group[0].get(results.COMMENTS, "").splitlines()
        job = yield Job(lambda job, c=[path] + command[1:], s=scene, p=proxy: check(job, c + commands.resources(choices), s, p))
        answer, words = job.result
        for thing in map(bpy.data.objects.get, names):
            if thing is not None:
                thing[results.PROOF] = words
        operator.changed = True
        operator.report({"INFO"} if answer == 0 else {"WARNING"}, f"{title}: {words}")


def _group_title(group: list[bpy.types.Object]) -> str:
    return group[0].name if len(group) == 1 else f"{group[0].name} ... {group[-1].name}"


def make(job: Job, choices: commands.Choices, path: str, name: str, scene: Scene) -> results.Result:
    """The job of an operator that makes a proxy: writes the scene, runs bplod, and reads what it made."""
    write(job.folder / commands.scene_file(choices.kind, name), scene)
    scene.meshes.clear()  # it may be large, and the tool needs the memory
    command = commands.make_command(choices, name)
    rows = commands.table(job.run([path] + command[1:] + commands.resources(choices)))
    version = job.run([path, "--version"]).split()[-1]
    rows = [row for row in rows if row["file"].endswith(CHOSEN_FILES[choices.kind])]
    files = []
    for row in rows:
        job.check()
        file = job.folder / "made" / row["file"]
        files.append(((read_obj if file.suffix == ".obj" else read_glb)(file), row))
    notes = [note for note in job.notes if _concerns(note, {row["file"] for row in rows})]
    return results.Result(choices.kind, files, shlex.join(command), version, choices.mode, notes)


def write(path: Path, scene: Scene) -> None:
    (write_obj if path.suffix == ".obj" else write_ply)(path, scene)


def _concerns(note: str, files: set[str]) -> bool:
    """True for a note that is not about a file which the operator does not take, or about the origin, which it takes care of."""
    named = re.match(r"(\S+\.(?:glb|obj))\b", note)
    return (named is None or named.group(1) in files) and "--origin auto" not in note


def check(job: Job, command: list[str], scene: Scene, proxy: Scene) -> tuple[int, str]:
    """The job of a proof. Returns 0 for proven, and what bpcheck says in its last line; of an occluder, also on which condition."""
    for name in command[1:]:
        if name.startswith(("scene.", "proxy.")):
            write(job.folder / name, scene if name.startswith("scene.") else proxy)
    lines = job.run(command, answers=(0, 1, 5)).splitlines()
    words = lines[-1] if lines else "bpcheck says nothing"
    condition = next((line.split("yes, if ", 1)[1] for line in lines if "yes, if " in line), "")
    holds = words.startswith("holds")
    return (0 if holds else 1), words + (f", if {condition}" if condition and holds else "")


class MakeCollision(Making, bpy.types.Operator):
    """Makes a closed mesh of few faces around the selected objects, for physics"""

    bl_idname = "bounding_proxies.collision"
    bl_label = "Collision body"
    kind = "COLLISION"


class MakeHulls(Making, bpy.types.Operator):
    """Makes convex hulls that enclose the selected objects together, with the names that Unreal expects"""

    bl_idname = "bounding_proxies.hulls"
    bl_label = "Convex hulls"
    kind = "HULLS"


class MakeOccluder(Making, bpy.types.Operator):
    """Makes a mesh within what the selected objects hide. Materials that let light through are no walls"""

    bl_idname = "bounding_proxies.occluder"
    bl_label = "Occluder"
    kind = "OCCLUDER"


class MakeLevels(Making, bpy.types.Operator):
    """Makes levels of detail of the selected objects, with textures or colours"""

    bl_idname = "bounding_proxies.levels"
    bl_label = "Levels"
    kind = "LEVELS"


class MakeCage(Making, bpy.types.Operator):
    """Makes a cage of quads around the selected objects, and binds them to it. Move the vertices of the cage, and the objects follow"""

    bl_idname = "bounding_proxies.cage"
    bl_label = "Cage"
    kind = "CAGE"


CLASSES = (MakeCollision, MakeHulls, MakeOccluder, MakeLevels, MakeCage, Check)
register, _unregister = bpy.utils.register_classes_factory(CLASSES)


def unregister() -> None:
    for job in running:
        job.cancel()
    _unregister()
