"""Presets: all settings of the panel under a name, as files of the user."""
from __future__ import annotations

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from .settings import BoundingProxiesSettings

FOLDER = "bounding_proxies"


class BOUNDING_PROXIES_PT_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Presets of proxies"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = "bounding_proxies.preset_add"


class AddPreset(AddPresetBase, bpy.types.Operator):
    """Keeps all settings of the panel under a name, or removes a preset"""

    bl_idname = "bounding_proxies.preset_add"
    bl_label = "Add Preset"
    preset_menu = "BOUNDING_PROXIES_PT_presets"
    preset_subdir = FOLDER
    preset_defines = ["settings = bpy.context.scene.bounding_proxies"]
    preset_values = [f"settings.{name}" for name in BoundingProxiesSettings.__annotations__]


CLASSES = (AddPreset, BOUNDING_PROXIES_PT_presets)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
