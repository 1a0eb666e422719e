"""Takes from Blender what it shows of objects: evaluated meshes with modifiers applied, instances, matrices and materials. Coordinates
are copied, not computed."""
from __future__ import annotations

from contextlib import contextmanager
from typing import Iterator

import bpy
import numpy as np

from .materials import Materials, Needs, moved
from .mesh_write import Part, Scene

SHAPES = {"MESH", "CURVE", "SURFACE", "META", "FONT", "CURVES"}


def gather(context: bpy.types.Context, objects: list[bpy.types.Object], looks: bool = False, normals: bool = False) -> Scene:
    """Returns what the view shows of the objects, with the instances that they make. looks: with materials; normals: with those of corners."""
    wanted = {thing.name_full for thing in objects}
    scene, known, table = Scene(), {}, Materials() if looks else None
    for instance in context.evaluated_depsgraph_get().object_instances:
        owner = instance.parent if instance.is_instance else instance.object
        if owner is None or owner.original.name_full not in wanted or not instance.show_self or instance.object.type not in SHAPES:
            continue
        # Every instance of a mesh takes it once. Pointers are those of evaluated data, which lives as long as the loop.
        thing = instance.object
        key = (thing.original.name_full, thing.data.as_pointer() if thing.data else 0)
        if key not in known:
            known[key] = len(scene.meshes)
            scene.meshes.append(_parts(thing, table, normals))
        scene.instances.append((known[key], np.array(instance.matrix_world, float)))
    if table:
        scene.materials, scene.images = table.materials, table.images
    return scene


def _parts(thing: bpy.types.Object, table: Materials | None, normals: bool) -> list[Part]:
    mesh = thing.to_mesh()
    if mesh is None:
        return []
    try:
        mesh.calc_loop_triangles()
        triangles = mesh.loop_triangles
        positions, corners = _read(mesh.vertices, "co", 3), _read(triangles, "vertices", 3, np.int32)
        if table is None or not len(triangles):
            return [Part(positions, corners)]
        loops, slots = _read(triangles, "loops", 3, np.int32), _read(triangles, "material_index", 1, np.int32)[:, 0]
        shading = _normals(mesh) if normals else None
        made = []
        for slot in np.unique(slots):
            places = thing.material_slots
            material = places[min(slot, len(places) - 1)].material if places else None
            chosen = slots == slot
            made.append(_part(mesh, positions, corners[chosen], loops[chosen].reshape(-1), table.add(material), shading))
        return made
    finally:
        thing.to_mesh_clear()


def _part(mesh: bpy.types.Mesh, positions: np.ndarray, corners: np.ndarray, loops: np.ndarray, material: tuple[int, Needs],
          shading: np.ndarray | None) -> Part:
    number, needs = material
    used, triangles = np.unique(corners, return_inverse=True)
    part = Part(positions[used], triangles.reshape(-1, 3), number)
    if needs.places and mesh.uv_layers:
        part.places = moved(_places(mesh, needs.uv_map)[loops], needs)
    if needs.colors:
        part.colors = _colors(mesh, needs.color_name, loops, corners.reshape(-1))
    if shading is not None:
        part.normals = shading[loops]
    return part


def _normals(mesh: bpy.types.Mesh) -> np.ndarray:
    if hasattr(mesh, "corner_normals"):  # since 4.1
        return _read(mesh.corner_normals, "vector", 3)
    mesh.calc_normals_split()
    return _read(mesh.loops, "normal", 3)


def _places(mesh: bpy.types.Mesh, name: str) -> np.ndarray:
    layer = mesh.uv_layers.get(name) or next((layer for layer in mesh.uv_layers if layer.active_render), mesh.uv_layers[0])
    return _read(layer.data, "uv", 2)


def _colors(mesh: bpy.types.Mesh, name: str, loops: np.ndarray, vertices: np.ndarray) -> np.ndarray | None:
    attribute = mesh.color_attributes.get(name) or mesh.color_attributes.active_color
    if attribute is None:
        return None
    return _read(attribute.data, "color", 4)[loops if attribute.domain == "CORNER" else vertices][:, :3]


def _read(collection, name: str, width: int, kind=np.float32) -> np.ndarray:
    values = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width)


@contextmanager
def shown(context: bpy.types.Context, objects: list[bpy.types.Object]) -> Iterator[None]:
    """Shows hidden objects while their evaluated meshes are read: Blender evaluates only what is visible."""
    there = set(context.view_layer.objects)
    hidden = [(thing, thing.hide_viewport, thing.hide_get()) for thing in objects if thing in there and not thing.visible_get()]
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
