"""The tab "Proxy" in the sidebar of the 3D view."""
from __future__ import annotations

import bpy

from . import results
from .presets import BOUNDING_PROXIES_PT_presets
from .settings import BoundingProxiesSettings


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Proxy"

    def column(self, context: bpy.types.Context) -> tuple[bpy.types.UILayout, BoundingProxiesSettings]:
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        return self.layout.column(), context.scene.bounding_proxies


class _Purpose(_Panel):
    """Settings of one kind of proxy, and the button that makes it."""

    settings: tuple[str, ...] = ()
    operator = ""
    icon = "NONE"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = self.column(context)
        for name in self.settings:
            column.prop(settings, name)
        column.separator()
        column.operator(f"bounding_proxies.{self.operator}", icon=self.icon)


class BOUNDING_PROXIES_PT_collision(_Purpose, bpy.types.Panel):
    bl_label = "Collision"
    settings = ("collision_faces", "engine", "hulls", "hull_corners")
    operator, icon = "collision", "MESH_ICOSPHERE"

    def draw_header_preset(self, context: bpy.types.Context) -> None:
        BOUNDING_PROXIES_PT_presets.draw_panel_header(self.layout)

    def draw(self, context: bpy.types.Context) -> None:
        super().draw(context)
        self.layout.operator("bounding_proxies.hulls", icon="MESH_CUBE")


class BOUNDING_PROXIES_PT_cage(_Purpose, bpy.types.Panel):
    bl_label = "Cage"
    settings = ("cage_faces", "margin", "symmetry", "bind", "precision")
    operator, icon = "cage", "MOD_MESHDEFORM"


class BOUNDING_PROXIES_PT_levels(_Purpose, bpy.types.Panel):
    bl_label = "Levels of detail"
    settings = ("level_faces", "level_mode", "appearance")
    operator, icon = "levels", "MOD_DECIM"


class BOUNDING_PROXIES_PT_occluder(_Purpose, bpy.types.Panel):
    bl_label = "Occluder"
    settings = ("occluder_faces", "engine")
    operator, icon = "occluder", "HOME"


class BOUNDING_PROXIES_PT_grid(_Panel, bpy.types.Panel):
    bl_label = "Scale and voxels"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = self.column(context)
        column.prop(settings, "scale_kind")
        if settings.scale_kind != "AUTO":
            column.prop(settings, "scale_percent" if settings.scale_kind == "PERCENT" else "scale_length")
        column.prop(settings, "grid_kind")
        if settings.grid_kind != "AUTO":
            column.prop(settings, "resolution" if settings.grid_kind == "RESOLUTION" else "voxel")


class BOUNDING_PROXIES_PT_proxies(_Panel, bpy.types.Panel):
    bl_label = "Proofs"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = self.column(context)
        column.prop(settings, "check_after")
        column.operator("bounding_proxies.check", icon="CHECKMARK")
        for proxy in results.proxies_of(context.selected_objects):
            words = proxy.get(results.PROOF, "")
            row = self.layout.row()
            row.label(text=proxy.name, icon="CHECKMARK" if words.startswith("holds") else "ERROR" if words else "QUESTION")
            row.label(text=f"{proxy.get('bp_faces', 0)} faces")
            if words and not words.startswith("holds"):
                self.layout.label(text=words)


CLASSES = (BOUNDING_PROXIES_PT_collision, BOUNDING_PROXIES_PT_cage, BOUNDING_PROXIES_PT_levels, BOUNDING_PROXIES_PT_occluder,
           BOUNDING_PROXIES_PT_grid, BOUNDING_PROXIES_PT_proxies)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
