"""Makes the materials of levels: base colour, and normals, roughness, metal and light where a level has images of them."""
from __future__ import annotations

import bpy


def make_material(name: str, text: dict, images: list[tuple[str, bytes]], colors: bool) -> bpy.types.Material:
    """`text` is the material as glTF has it, with the image of each texture as `images`. colors: the mesh has colours of corners."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    surface = text.get("pbrMetallicRoughness", {})
    factor = surface.get("baseColorFactor", [1, 1, 1, 1])
    shader.inputs["Base Color"].default_value = material.diffuse_color = factor
    shader.inputs["Metallic"].default_value = surface.get("metallicFactor", 1)
    shader.inputs["Roughness"].default_value = surface.get("roughnessFactor", 1)

    def add(kind: str, x: float, y: float) -> bpy.types.Node:
        node = nodes.new(kind)
        node.location = (x, y)
        return node

    def image(info: dict, what: str, y: float, is_color: bool = False) -> bpy.types.NodeSocket:
        node = add("ShaderNodeTexImage", -700, y)
        node.image = _image(f"{name}_{what}", images[text["images"][info["index"]]][1])
        if not is_color:
            node.image.colorspace_settings.name = "Non-Color"
        return node.outputs["Color"]

    if "baseColorTexture" in surface:
        links.new(image(surface["baseColorTexture"], "color", 300, True), shader.inputs["Base Color"])
    elif colors:
        node = add("ShaderNodeVertexColor", -300, 300)
        node.layer_name = "Color"
        links.new(node.outputs["Color"], shader.inputs["Base Color"])
    if "metallicRoughnessTexture" in surface:
        split = add("ShaderNodeSeparateColor", -350, 0)
        links.new(image(surface["metallicRoughnessTexture"], "rough", 0), split.inputs[0])
        links.new(split.outputs[1], shader.inputs["Roughness"])
        links.new(split.outputs[2], shader.inputs["Metallic"])
    if "normalTexture" in text:
        bump = add("ShaderNodeNormalMap", -350, -300)
        links.new(image(text["normalTexture"], "normal", -300), bump.inputs["Color"])
        links.new(bump.outputs["Normal"], shader.inputs["Normal"])
    if "emissiveTexture" in text:
        light = shader.inputs["Emission Color" if "Emission Color" in shader.inputs else "Emission"]
        links.new(image(text["emissiveTexture"], "light", -600, True), light)
        shader.inputs["Emission Strength"].default_value = 1
    return material


def _image(name: str, contents: bytes) -> bpy.types.Image:
    """Makes a packed image of a file's contents. It keeps nothing on disk."""
    image = bpy.data.images.new(name, 1, 1)
    image.pack(data=contents, data_len=len(contents))
    image.source = "FILE"
    return image
