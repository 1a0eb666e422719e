"""Proxies in the scene: objects that know what they were made of, in a collection of their own. A proxy of the same kind and sources takes the
place of the one before."""
from __future__ import annotations

import re
from dataclasses import dataclass, field

import bpy
import numpy as np

from .level_material import make_material
from .mesh_read import Made, Mesh

MODIFIER = "Proxy cage"
# What a proxy tells of itself, as custom properties.
KIND, SOURCES, PROOF, COMMENTS = "bp_kind", "bp_sources", "bp_proof", "bp_comments"
TITLES = {"COLLISION": "Collision body", "HULLS": "Convex hulls", "OCCLUDER": "Occluder", "LEVELS": "Levels", "CAGE": "Cage"}
BODY_NAMES = {"PLAIN": "{}_collision", "GODOT": "{}-colonly", "UNITY": "{}_Collider"}
OCCLUDER_NAMES = {"PLAIN": "{}_occluder", "GODOT": "{}-occonly", "UNITY": "{}_occluder"}


@dataclass
class Result:
    """What a run has made: files as they were read, and a line of bplod's list for each."""

    kind: str
    files: list[tuple[Made, dict[str, str]]]
    command: str
    version: str
    mode: str = "bounding"
    notes: list[str] = field(default_factory=list)


def is_proxy(thing: bpy.types.Object) -> bool:
    return KIND in thing


def is_cage(thing: bpy.types.Object) -> bool:
    return thing.get(KIND) == "CAGE"


def sources_of(proxy: bpy.types.Object) -> list[bpy.types.Object]:
    """Returns the objects that a proxy was made of, as far as they are still in a scene. Names may have changed."""
    group = proxy.get(SOURCES)
    return [thing for thing in group.values() if thing is not None and thing.users_scene] if group is not None else []


def proxies_of(things: list[bpy.types.Object]) -> list[bpy.types.Object]:
    """Returns all proxies that were made of any of the objects, or are among them."""
    found = [o for o in bpy.data.objects if is_proxy(o) and (o in things or any(source in things for source in sources_of(o)))]
    return sorted(found, key=lambda o: o.name)


def place(context: bpy.types.Context, result: Result, name: str, sources: list[bpy.types.Object], engine: str) -> list[bpy.types.Object]:
    """Puts a result into the scene, and takes away what the same run made before. Returns the new objects."""
    old = [o for o in bpy.data.objects if o.get(KIND) == result.kind and set(sources_of(o)) == set(sources)]
    collection = _collection(context, name, sources)
    for thing in old:
        _remove(thing)
    made = []
    for number, (file, row) in enumerate(result.files):
        for part, mesh in enumerate(file.meshes):
            title = _title(result.kind, name, number, part, engine)
            thing = bpy.data.objects.new(title, _mesh(title, mesh, file))
            thing.location = file.origin
            _describe(thing, result, file, mesh, row, sources)
            _show(thing, result.kind)
            collection.objects.link(thing)
            made.append(thing)
            if not _is_exact(mesh, thing):
                result.notes.append(f"{title}: Blender rounds its coordinates; prove it as it lies in the scene")
    for coarser in made[1:] if result.kind == "LEVELS" else []:
        coarser.hide_set(True)
    context.view_layer.update()
    return made


def _collection(context: bpy.types.Context, name: str, sources: list[bpy.types.Object]) -> bpy.types.Collection:
    """Returns the collection in which other proxies of the sources lie, or "NAME proxies" of this scene."""
    known = context.scene.collection.children_recursive
    for proxy in proxies_of(sources):
        for collection in proxy.users_collection:
            if collection in known and set(sources_of(proxy)) == set(sources) and collection.name.endswith(" proxies"):
                return collection
    title = f"{name} proxies"
    found = next((c for c in known if c.name == title), None)
    if found is None:
        found = bpy.data.collections.new(title)
        context.scene.collection.children.link(found)
    return found


def _remove(thing: bpy.types.Object) -> None:
    """Removes a proxy with its mesh, materials and images, as far as nothing else uses them."""
    mesh = thing.data
    bpy.data.objects.remove(thing)
    if mesh.users:
        return
    materials = [material for material in mesh.materials if material]
    bpy.data.meshes.remove(mesh)
    for material in materials:
        if material.users:
            continue
        images = {node.image for node in material.node_tree.nodes if node.type == "TEX_IMAGE" and node.image}
        bpy.data.materials.remove(material)
        for image in images:
            if not image.users:
                bpy.data.images.remove(image)


def _title(kind: str, name: str, number: int, part: int, engine: str) -> str:
    if kind == "HULLS":
        return f"UCX_{name}_{part:02d}"
    if kind == "LEVELS":
        return f"{name}_LOD{number}"
    if kind == "CAGE":
        return f"{name}_cage"
    return (BODY_NAMES if kind == "COLLISION" else OCCLUDER_NAMES)[engine].format(name)


def _mesh(title: str, mesh: Mesh, file: Made) -> bpy.types.Mesh:
    made = bpy.data.meshes.new(title)
    begins = np.concatenate([[0], np.cumsum(mesh.sizes)])
    corners = mesh.corners.tolist()
    made.from_pydata(mesh.vertices.tolist(), [], [corners[a:b] for a, b in zip(begins[:-1].tolist(), begins[1:].tolist())])
    if mesh.places is not None:
        made.uv_layers.new(name="UVMap").data.foreach_set("uv", mesh.places.astype(np.float32).ravel())
    if mesh.colors is not None:
        colors = mesh.colors if mesh.colors.shape[1] == 4 else np.insert(mesh.colors, 3, 1, axis=1)
        made.color_attributes.new("Color", "FLOAT_COLOR", "CORNER").data.foreach_set("color", colors.astype(np.float32).ravel())
    if mesh.places is not None or mesh.colors is not None:  # a level, which people look at
        if mesh.normals is not None:
            made.polygons.foreach_set("use_smooth", [True] * len(made.polygons))
            if hasattr(made, "use_auto_smooth"):  # until 4.0
                made.use_auto_smooth = True
            made.normals_split_custom_set(mesh.normals.tolist())
        if mesh.material is not None:
            made.materials.append(make_material(title, mesh.material, file.images, mesh.colors is not None))
    made.update()
    return made


def _is_exact(mesh: Mesh, thing: bpy.types.Object) -> bool:
    """True if Blender's 32-bit floats hold the coordinates that the tool has proven."""
    return np.array_equal(mesh.vertices, mesh.vertices.astype(np.float32)) and tuple(thing.location) == tuple(
        float(np.float32(c)) for c in thing.location)


def _describe(thing: bpy.types.Object, result: Result, file: Made, mesh: Mesh, row: dict[str, str],
              sources: list[bpy.types.Object]) -> None:
    thing[KIND] = result.kind
    thing[SOURCES] = {str(i): source for i, source in enumerate(sources)}
    thing["bp_mode"] = result.mode
    thing["bp_faces"] = int((mesh.sizes - 2).sum())  # triangles, as --faces counts
    for name in ("scale", "voxel", "error"):
        if row.get(name, "-") != "-":
            thing[f"bp_{name}"] = float(row[name])
    thing["bp_command"], thing["bp_version"] = result.command, result.version
    # bpcheck's answers about occluders, and its hints, rest on what the file tells of itself.
    thing[COMMENTS] = "\n".join(file.comments)
    thing["bp_contract"] = next((line[len("contract: "):] for line in file.comments if line.startswith("contract: ")), "")


def _show(thing: bpy.types.Object, kind: str) -> None:
    if kind != "LEVELS":
        thing.display_type = "WIRE"
        thing.hide_render = True


def margin_of(proxy: bpy.types.Object) -> str:
    """Returns the margin that a cage was made with, in scene units; empty if it has none."""
    found = re.search(r"\bmargin=(\S+)", proxy.get(COMMENTS, ""))
    return found.group(1) if found else ""


def bind(context: bpy.types.Context, cage: bpy.types.Object, sources: list[bpy.types.Object], precision: int) -> list[str]:
    """Binds the sources to the cage, each by a modifier Mesh Deform. A modifier of an earlier cage is used again, and keeps its place.
    Returns the names of those that cannot be bound."""
    failed = []
    for thing in sources:
        if thing.type != "MESH" or thing.library:
            failed.append(thing.name)
            continue
        modifier = thing.modifiers.get(MODIFIER) or thing.modifiers.new(MODIFIER, "MESH_DEFORM")
        try:
            if modifier.is_bound:
                _toggle(context, thing, modifier)
            modifier.object, modifier.precision, modifier.show_viewport = cage, precision, True
            context.view_layer.update()
            _toggle(context, thing, modifier)
        except RuntimeError:
            pass
        if not modifier.is_bound:
            thing.modifiers.remove(modifier)
            failed.append(thing.name)
    return failed


def unbind(sources: list[bpy.types.Object]) -> None:
    """Removes modifiers whose cage is gone."""
    for thing in sources:
        modifier = thing.modifiers.get(MODIFIER)
        if modifier is not None and modifier.object is None:
            thing.modifiers.remove(modifier)


def _toggle(context: bpy.types.Context, thing: bpy.types.Object, modifier: bpy.types.Modifier) -> None:
    with context.temp_override(object=thing, active_object=thing, selected_objects=[thing]):
        bpy.ops.object.meshdeform_bind(modifier=modifier.name)
