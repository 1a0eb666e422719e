"""Reads Blender's materials for the tools: colours, glass, and images of what the principled shader takes."""
from __future__ import annotations

import os
import struct
import zlib
from dataclasses import dataclass

import bpy
import numpy as np

from .mesh_write import Material, srgb

GLASS = {"BSDF_GLASS", "BSDF_REFRACTION", "BSDF_TRANSPARENT"}
SHADERS = GLASS | {"BSDF_DIFFUSE", "BSDF_GLOSSY", "EMISSION"}
COLOR_NODES = {"VERTEX_COLOR", "ATTRIBUTE"}
CHANNELS = {"R": 0, "Red": 0, "G": 1, "Green": 1, "B": 2, "Blue": 2}


@dataclass
class Needs:
    """What a material takes from its mesh. `mapping` moves places in images: location, angle and scale."""

    places: bool = False
    uv_map: str = ""
    mapping: tuple[list[float], float, list[float]] | None = None
    colors: bool = False
    color_name: str = ""


class Materials:
    """The materials of a scene, each once, and their images."""

    def __init__(self) -> None:
        self.materials: list[Material] = []
        self.images: list[tuple[str, bytes]] = []
        self._known: dict[str, tuple[int, Needs]] = {}
        self._numbers: dict[tuple[str, int | None], int] = {}

    def add(self, material: bpy.types.Material | None) -> tuple[int, Needs]:
        """Returns the number of the material, or -1 for none, and what it needs."""
        if material is None:
            return -1, Needs()
        if material.name_full not in self._known:
            needs = Needs()
            self.materials.append(self._read(material, needs))
            self._known[material.name_full] = (len(self.materials) - 1, needs)
        return self._known[material.name_full]

    def _read(self, material: bpy.types.Material, needs: Needs) -> Material:
        shader = _shader(material)
        if shader is None:
            *color, alpha = material.diffuse_color
            return Material(color=color, alpha=alpha)
        made = Material(roughness=_number(shader, "Roughness", 1), metal=_number(shader, "Metallic", 0), alpha=_number(shader, "Alpha", 1))
        base = _socket(shader, "Base Color", "Color")
        if base is not None:
            made.color = list(base.default_value)[:3]
            if not self._image(base, "map_Kd", made, needs) and base.is_linked:
                self._color(base, made, needs)
        opacity = _socket(shader, "Alpha")
        clear = _number(shader, "Transmission Weight", _number(shader, "Transmission", 0))
        made.is_glass = shader.type in GLASS or clear > 0.5 or (opacity is not None and opacity.is_linked)
        for name, key in (("Roughness", "map_Pr"), ("Metallic", "map_Pm"), ("Normal", "norm")):
            self._image(_socket(shader, name), key, made, needs)
        light = _socket(shader, "Emission Color", "Emission", "Color" if shader.type == "EMISSION" else "Emission")
        strength = min(_number(shader, "Emission Strength", _number(shader, "Strength", 1)), 1)
        if light is not None and strength > 0 and not self._image(light, "map_Ke", made, needs):
            made.light = [c * strength for c in list(light.default_value)[:3]]
        return made

    def _color(self, base: bpy.types.NodeSocket, made: Material, needs: Needs) -> None:
        node = _upstream(base, COLOR_NODES)
        if node is not None:
            needs.colors, needs.color_name = True, getattr(node, "layer_name", "") or getattr(node, "attribute_name", "")
            made.color = [1.0, 1.0, 1.0]

    def _image(self, socket: bpy.types.NodeSocket | None, key: str, made: Material, needs: Needs) -> bool:
        """Adds the image that a socket shows; False if there is none."""
        node = _upstream(socket, {"TEX_IMAGE"}) if socket is not None and socket.is_linked else None
        if node is None or node.image is None:
            return False
        vector = node.inputs["Vector"]
        other = _upstream(vector, {"TEX_COORD"}) if vector.is_linked else None
        if other is not None and not other.outputs["UV"].is_linked:
            return False  # generated coordinates and those of objects have no counterpart in files
        number = self._image_number(node.image, _channel(socket) if key in ("map_Pr", "map_Pm") else None)
        if number is None:
            return False
        made.images[key] = number
        if not needs.places:  # all images of a material lie where the first does
            mapping = _upstream(vector, {"MAPPING"}) if vector.is_linked else None
            needs.mapping = _mapping(mapping) if mapping is not None else None
            uv_map = _upstream(vector, {"UVMAP"}) if vector.is_linked else None
            needs.uv_map = uv_map.uv_map if uv_map is not None else ""
            needs.places = True
        return True

    def _image_number(self, image: bpy.types.Image, channel: int | None) -> int | None:
        key = (image.name_full, channel)
        if key not in self._numbers:
            found = _image_file(image) if channel is None else None
            found = found or _pixels_as_png(image, channel)
            if found is None:
                return None
            self._numbers[key] = len(self.images)
            self.images.append(found)
        return self._numbers[key]


def moved(places: np.ndarray, needs: Needs) -> np.ndarray:
    """Returns places in images as the material's mapping moves them."""
    if needs.mapping is None:
        return places
    location, angle, scale = needs.mapping
    u, v = places[:, 0] * scale[0], places[:, 1] * scale[1]
    sine, cosine = np.sin(angle), np.cos(angle)
    return np.stack([cosine * u - sine * v + location[0], sine * u + cosine * v + location[1]], axis=1)


def _shader(material: bpy.types.Material) -> bpy.types.Node | None:
    """Returns the shader that tells most: the principled one, else any with a colour."""
    if not material.use_nodes or material.node_tree is None:
        return None
    output = material.node_tree.get_output_node("ALL")
    if output is None or not output.inputs["Surface"].is_linked:
        return None
    return _upstream(output.inputs["Surface"], {"BSDF_PRINCIPLED"}) or _upstream(output.inputs["Surface"], SHADERS)


def _upstream(socket: bpy.types.NodeSocket, kinds: set[str]) -> bpy.types.Node | None:
    """Returns the nearest node of one of the kinds among those that a socket depends on."""
    waiting, seen = [link.from_node for link in socket.links], set()
    while waiting:
        node = waiting.pop(0)
        if node.type in kinds:
            return node
        if node.name not in seen:
            seen.add(node.name)
            waiting += [link.from_node for entry in node.inputs for link in entry.links]
    return None


def _channel(socket: bpy.types.NodeSocket) -> int | None:
    """Returns which channel of an image a socket takes, if a node separates them."""
    link = socket.links[0]
    return CHANNELS.get(link.from_socket.name) if link.from_node.type in {"SEPRGB", "SEPARATE_COLOR"} else None


def _socket(node: bpy.types.Node, *names: str) -> bpy.types.NodeSocket | None:
    return next((node.inputs[name] for name in names if name in node.inputs), None)


def _number(node: bpy.types.Node, name: str, otherwise: float) -> float:
    socket = _socket(node, name)
    return float(socket.default_value) if socket is not None else float(otherwise)


def _mapping(node: bpy.types.Node) -> tuple[list[float], float, list[float]]:
    location, rotation, scale = (_socket(node, name) for name in ("Location", "Rotation", "Scale"))
    return (list(location.default_value) if location else [0, 0, 0], rotation.default_value[2], list(scale.default_value))


def _image_file(image: bpy.types.Image) -> tuple[str, bytes] | None:
    """Returns the image's file as it is, if it is a PNG or JPEG."""
    if image.is_dirty:
        return None
    data = b""
    if image.packed_file is not None:
        data = bytes(image.packed_file.data)
    elif image.source == "FILE":
        path = bpy.path.abspath(image.filepath, library=image.library)
        if os.path.isfile(path):
            with open(path, "rb") as file:
                data = file.read()
    return ("png", data) if data[:4] == b"\x89PNG" else ("jpg", data) if data[:2] == b"\xff\xd8" else None


def _pixels_as_png(image: bpy.types.Image, channel: int | None) -> tuple[str, bytes] | None:
    """Returns the pixels of any image that Blender has, or one channel of them as grey."""
    width, height = image.size
    if not width or not height or image.channels not in (3, 4):
        return None
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, image.channels)[::-1]
    if channel is not None:
        pixels = np.repeat(pixels[..., channel:channel + 1], 3, axis=2)
    elif image.is_float:  # linear, and files are not
        pixels = np.concatenate([srgb(pixels[..., :3]), pixels[..., 3:]], axis=2)
    return "png", _png(np.round(np.clip(pixels, 0, 1) * 255).astype(np.uint8))


def _png(pixels: np.ndarray) -> bytes:
    height, width, channels = pixels.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels.reshape(height, -1)], axis=1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 6, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows.tobytes(), 3)) + chunk(b"IEND", b""))
