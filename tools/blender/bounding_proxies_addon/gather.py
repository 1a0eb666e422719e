"""Takes from Blender what it shows of objects: evaluated meshes with modifiers applied, instances, matrices, and materials."""
from __future__ import annotations

from contextlib import contextmanager
from typing import Iterator

import bpy
import numpy as np

from . import glb_write
from .materials import Materials

SHAPES = {"MESH", "CURVE", "SURFACE", "META", "FONT", "CURVES"}


def gather(context: bpy.types.Context, objects: list[bpy.types.Object], materials: bool = True) -> glb_write.Scene:
    """Returns what the view shows of the objects, with the instances that they make. Coordinates and matrices are copied, not computed."""
    wanted = {thing.name_full for thing in objects}
    scene, known, table = glb_write.Scene(), {}, Materials()
    for instance in context.evaluated_depsgraph_get().object_instances:
        owner = instance.parent if instance.is_instance else instance.object
        if owner is None or owner.original.name_full not in wanted or not instance.show_self or instance.object.type not in SHAPES:
            continue
        # Every instance of a mesh writes it once. Pointers are those of evaluated data, which lives as long as the loop.
        thing = instance.object
        key = (thing.original.name_full, thing.data.as_pointer() if thing.data else 0)
        if key not in known:
            known[key] = len(scene.meshes)
            scene.meshes.append(_parts(thing, table if materials else None))
        matrix = [float(entry) for column in zip(*instance.matrix_world) for entry in column]
        scene.instances.append((known[key], thing.original.name, matrix))
    scene.materials, scene.images = table.texts, table.images
    return scene


def _parts(thing: bpy.types.Object, table: Materials | None) -> list[glb_write.Part]:
    mesh = thing.to_mesh()
    if mesh is None:
        return []
    try:
        mesh.calc_loop_triangles()
        triangles = mesh.loop_triangles
        positions = _read(mesh.vertices, "co", 3)
        vertices = _read(triangles, "vertices", 3, np.int32)
        if table is None or not len(triangles):
            return [glb_write.Part(positions, vertices.reshape(-1).astype(np.uint32))]
        loops = _read(triangles, "loops", 3, np.int32)
        slots = _read(triangles, "material_index", 1, np.int32)[:, 0]
        made = []
        for slot in np.unique(slots):
            slot_materials = thing.material_slots
            material = slot_materials[min(slot, len(slot_materials) - 1)].material if slot_materials else None
            chosen = slots == slot
            made.append(_part(mesh, positions, vertices[chosen], loops[chosen].reshape(-1), table, material))
        return made
    finally:
        thing.to_mesh_clear()


def _part(mesh: bpy.types.Mesh, positions: np.ndarray, vertices: np.ndarray, loops: np.ndarray, table: Materials,
          material: bpy.types.Material | None) -> glb_write.Part:
    number, needs = table.add(material)
    places = _places(mesh, needs.uv_map)[loops] if needs.places and mesh.uv_layers else None
    colors = _colors(mesh, needs.color_name, loops, vertices.reshape(-1)) if needs.colors else None
    if places is None and colors is None:
        used, indices = np.unique(vertices.reshape(-1), return_inverse=True)
        return glb_write.Part(positions[used], indices.astype(np.uint32), number)
    return glb_write.Part(positions[vertices.reshape(-1)], np.arange(vertices.size, dtype=np.uint32), number, places, colors)


def _places(mesh: bpy.types.Mesh, name: str) -> np.ndarray:
    layer = mesh.uv_layers.get(name) or next((layer for layer in mesh.uv_layers if layer.active_render), mesh.uv_layers[0])
    return _read(layer.data, "uv", 2)


def _colors(mesh: bpy.types.Mesh, name: str, loops: np.ndarray, vertices: np.ndarray) -> np.ndarray | None:
    attribute = mesh.color_attributes.get(name) or mesh.color_attributes.active_color
    if attribute is None:
        return None
    return _read(attribute.data, "color", 4)[loops if attribute.domain == "CORNER" else vertices]


def _read(collection, name: str, width: int, kind=np.float32) -> np.ndarray:
    values = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width)


@contextmanager
def shown(context: bpy.types.Context, objects: list[bpy.types.Object]) -> Iterator[None]:
    """Shows hidden objects while their evaluated meshes are read: Blender evaluates only what is visible."""
    hidden = [(thing, thing.hide_viewport, thing.hide_get()) for thing in objects if not thing.visible_get()]
    for thing, _, _ in hidden:
        thing.hide_viewport = False
        thing.hide_set(False)
    context.view_layer.update()
    try:
        yield
    finally:
        for thing, viewport, eye in hidden:
            thing.hide_viewport = viewport
            thing.hide_set(eye)
        context.view_layer.update()


@contextmanager
def at_rest(context: bpy.types.Context, objects: list[bpy.types.Object], is_cage) -> Iterator[None]:
    """Switches off what cages of ours do to the objects, so that a new cage encloses them as they were before."""
    modifiers = [m for thing in objects for m in thing.modifiers if m.type == "MESH_DEFORM" and m.object and is_cage(m.object) and m.show_viewport]
    for modifier in modifiers:
        modifier.show_viewport = False
    context.view_layer.update()
    try:
        yield
    finally:
        for modifier in modifiers:
            modifier.show_viewport = True
        context.view_layer.update()
