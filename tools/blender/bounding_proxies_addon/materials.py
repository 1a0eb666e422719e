"""Materials: Blender's as glTF has them, for the tools to read; and those of levels as Blender has them."""
from __future__ import annotations

import os
import struct
import zlib
from dataclasses import dataclass

import bpy
import numpy as np

SHADERS_OF_GLASS = {"BSDF_GLASS", "BSDF_REFRACTION", "BSDF_TRANSPARENT"}
COLOR_NODES = {"VERTEX_COLOR", "ATTRIBUTE"}


@dataclass
class Needs:
    """What a material takes from its mesh."""

    places: bool = False
    uv_map: str = ""
    colors: bool = False
    color_name: str = ""


class Materials:
    """The materials of a scene, each once, as glTF has them, and their images."""

    def __init__(self) -> None:
        self.texts: list[dict] = []
        self.images: list[tuple[str, bytes]] = []
        self._known: dict[str, tuple[int, Needs]] = {}
        self._image_numbers: dict[str, int] = {}

    def add(self, material: bpy.types.Material | None) -> tuple[int, Needs]:
        """Returns the number of the material, or -1 for none, and what it needs."""
        if material is None:
            return -1, Needs()
        key = material.name_full
        if key not in self._known:
            needs = Needs()
            self.texts.append(self._text(material, needs))
            self._known[key] = (len(self.texts) - 1, needs)
        return self._known[key]

    def _text(self, material: bpy.types.Material, needs: Needs) -> dict:
        shader = _shader(material)
        if shader is None:
            color = list(material.diffuse_color)
            text = {"name": material.name, "pbrMetallicRoughness": {"baseColorFactor": color, "metallicFactor": 0}}
            return text if color[3] >= 1 else {**text, "alphaMode": "BLEND"}
        surface: dict = {"metallicFactor": _number(shader, "Metallic", 0.0), "roughnessFactor": _number(shader, "Roughness", 1.0)}
        text = {"name": material.name, "pbrMetallicRoughness": surface, "doubleSided": True}
        base = _socket(shader, "Base Color", "Color")
        color = list(base.default_value)[:3] if base is not None else [0.8, 0.8, 0.8]
        image = self._texture(base, needs)
        if image:
            surface["baseColorTexture"], color = image, [1.0, 1.0, 1.0]
        elif base is not None and base.is_linked:
            node = _upstream(base, COLOR_NODES)
            if node is not None:
                needs.colors, needs.color_name = True, getattr(node, "layer_name", "") or getattr(node, "attribute_name", "")
                color = [1.0, 1.0, 1.0]
        alpha = _number(shader, "Alpha", 1.0)
        surface["baseColorFactor"] = [min(max(c, 0.0), 1.0) for c in color] + [alpha]
        opacity = _socket(shader, "Alpha")
        clear = _number(shader, "Transmission Weight", _number(shader, "Transmission", 0.0))
        if alpha < 1 or (opacity is not None and opacity.is_linked) or clear > 0.5 or shader.type in SHADERS_OF_GLASS:
            text["alphaMode"] = "BLEND"
        self._other_textures(shader, surface, text, needs)
        return text

    def _other_textures(self, shader: bpy.types.Node, surface: dict, text: dict, needs: Needs) -> None:
        rough = self._texture(_socket(shader, "Roughness"), needs)
        if rough:  # green is roughness and blue is metal, as Blender's own exporter and importer have it
            surface["metallicRoughnessTexture"], surface["roughnessFactor"] = rough, 1.0
            if self._texture(_socket(shader, "Metallic"), needs):
                surface["metallicFactor"] = 1.0
        normal = self._texture(_socket(shader, "Normal"), needs, through={"NORMAL_MAP"})
        if normal:
            text["normalTexture"] = normal
        light = _socket(shader, "Emission Color", "Emission")
        strength = min(_number(shader, "Emission Strength", 1.0), 1.0)
        image = self._texture(light, needs)
        if image and strength > 0:
            text["emissiveTexture"], text["emissiveFactor"] = image, [strength] * 3
        elif light is not None and strength > 0 and shader.type in {"BSDF_PRINCIPLED", "EMISSION"}:
            text["emissiveFactor"] = [min(max(c * strength, 0.0), 1.0) for c in list(light.default_value)[:3]]

    def _texture(self, socket, needs: Needs, through: set[str] | None = None) -> dict | None:
        node = _upstream(socket, {"TEX_IMAGE"}, through) if socket is not None and socket.is_linked else None
        if node is None or node.image is None:
            return None
        image = self._image(node.image)
        if image is None:
            return None
        vector = node.inputs["Vector"]
        other = _upstream(vector, {"TEX_COORD"}) if vector.is_linked else None
        if other is not None and not other.outputs["UV"].is_linked:
            return None  # generated coordinates and those of objects have no counterpart in files
        needs.places = True
        texture = {"index": image}
        mapping = _upstream(vector, {"MAPPING"}) if vector.is_linked else None
        if mapping is not None:
            texture["extensions"] = {"KHR_texture_transform": _transform(mapping)}
        uv_map = _upstream(vector, {"UVMAP"}) if vector.is_linked else None
        if uv_map is not None:
            needs.uv_map = uv_map.uv_map
        return texture

    def _image(self, image: bpy.types.Image) -> int | None:
        if image.name_full not in self._image_numbers:
            data = _image_bytes(image)
            if data is None:
                return None
            self._image_numbers[image.name_full] = len(self.images)
            self.images.append(("image/jpeg" if data[:2] == b"\xff\xd8" else "image/png", data))
        return self._image_numbers[image.name_full]


def _shader(material: bpy.types.Material) -> bpy.types.Node | None:
    """Returns the shader that tells most: the principled one, else any with a colour."""
    if not material.use_nodes or material.node_tree is None:
        return None
    output = material.node_tree.get_output_node("ALL")
    if output is None or not output.inputs["Surface"].is_linked:
        return None
    return _upstream(output.inputs["Surface"], {"BSDF_PRINCIPLED"}) or _upstream(
        output.inputs["Surface"], SHADERS_OF_GLASS | {"BSDF_DIFFUSE", "BSDF_GLOSSY", "EMISSION"})


def _upstream(socket, kinds: set[str], through: set[str] | None = None) -> bpy.types.Node | None:
    """Returns the nearest node of one of the kinds among those that a socket depends on. `through`: only along nodes of these kinds, or
    directly."""
    waiting, seen = [link.from_node for link in socket.links], set()
    while waiting:
        node = waiting.pop(0)
        if node.type in kinds:
            return node
        if node.name in seen or (through is not None and node.type not in through):
            continue
        seen.add(node.name)
        waiting += [link.from_node for entry in node.inputs for link in entry.links]
    return None


def _socket(node: bpy.types.Node, *names: str):
    return next((node.inputs[name] for name in names if name in node.inputs), None)


def _number(node: bpy.types.Node, name: str, otherwise: float) -> float:
    socket = _socket(node, name)
    return float(socket.default_value) if socket is not None else otherwise


def _transform(mapping: bpy.types.Node) -> dict:
    """Returns a mapping of places as KHR_texture_transform has it, whose v points down."""
    location, rotation, scale = (_vector(mapping, name) for name in ("Location", "Rotation", "Scale"))
    turn, sine, cosine = rotation[2], np.sin(rotation[2]), np.cos(rotation[2])
    return {"offset": [float(location[0] - scale[1] * sine), float(1 - location[1] - scale[1] * cosine)], "rotation": float(turn),
            "scale": [float(scale[0]), float(scale[1])]}


def _vector(node: bpy.types.Node, name: str) -> list[float]:
    socket = _socket(node, name)
    return list(socket.default_value) if socket is not None else [0.0, 0.0, 0.0]


def _image_bytes(image: bpy.types.Image) -> bytes | None:
    """Returns the image as PNG or JPEG: its file as it is, or its pixels."""
    if not image.is_dirty:
        if image.packed_file is not None:
            data = bytes(image.packed_file.data)
        else:
            path = bpy.path.abspath(image.filepath, library=image.library)
            data = open(path, "rb").read() if image.source == "FILE" and os.path.isfile(path) else b""
        if data[:4] == b"\x89PNG" or data[:2] == b"\xff\xd8":
            return data
    width, height = image.size
    if not width or not height or image.channels not in (3, 4):
        return None
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, image.channels)[::-1]
    if image.is_float:  # linear, and files are not
        linear = np.clip(pixels[..., :3], 0, 1)
        pixels = np.concatenate([np.where(linear < 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055), pixels[..., 3:]], axis=2)
    return _png(np.round(np.clip(pixels, 0, 1) * 255).astype(np.uint8))


def _png(pixels: np.ndarray) -> bytes:
    height, width, channels = pixels.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels.reshape(height, -1)], axis=1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 6, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows.tobytes(), 3)) + chunk(b"IEND", b""))


def make_material(name: str, text: dict, images: list[tuple[str, bytes]], colors: bool) -> bpy.types.Material:
    """Makes the material of a level: base colour, and normals, roughness, metal and light where the level has images of them."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    surface = text.get("pbrMetallicRoughness", {})
    factor = surface.get("baseColorFactor", [1, 1, 1, 1])
    shader.inputs["Base Color"].default_value = factor
    shader.inputs["Metallic"].default_value = surface.get("metallicFactor", 1)
    shader.inputs["Roughness"].default_value = surface.get("roughnessFactor", 1)
    material.diffuse_color = factor

    def image(info: dict, kind: str, row: int, data: bool) -> bpy.types.Node:
        node = nodes.new("ShaderNodeTexImage")
        node.location = (-700, 300 - 300 * row)
        node.image = _load(f"{name}_{kind}", images[text["images"][info["index"]]][1])
        if data:
            node.image.colorspace_settings.name = "Non-Color"
        return node

    if "baseColorTexture" in surface:
        links.new(image(surface["baseColorTexture"], "color", 0, False).outputs["Color"], shader.inputs["Base Color"])
    elif colors:
        node = nodes.new("ShaderNodeVertexColor")
        node.layer_name, node.location = "Color", (-300, 300)
        links.new(node.outputs["Color"], shader.inputs["Base Color"])
    if "metallicRoughnessTexture" in surface:
        split = nodes.new("ShaderNodeSeparateColor")
        split.location = (-350, 0)
        links.new(image(surface["metallicRoughnessTexture"], "rough", 1, True).outputs["Color"], split.inputs[0])
        links.new(split.outputs[1], shader.inputs["Roughness"])
        links.new(split.outputs[2], shader.inputs["Metallic"])
    if "normalTexture" in text:
        bump = nodes.new("ShaderNodeNormalMap")
        bump.location = (-350, -300)
        links.new(image(text["normalTexture"], "normal", 2, True).outputs["Color"], bump.inputs["Color"])
        links.new(bump.outputs["Normal"], shader.inputs["Normal"])
    light = _socket(shader, "Emission Color", "Emission")
    if "emissiveTexture" in text:
        links.new(image(text["emissiveTexture"], "light", 3, False).outputs["Color"], light)
        shader.inputs["Emission Strength"].default_value = 1
    return material


def _load(name: str, contents: bytes) -> bpy.types.Image:
    """Makes a packed image of a file's contents. It keeps nothing on disk."""
    image = bpy.data.images.new(name, 1, 1)
    image.pack(data=contents, data_len=len(contents))
    image.source = "FILE"
    return image
