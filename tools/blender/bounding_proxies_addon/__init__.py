"""Bounding proxies in Blender: collision bodies, convex hulls, occluders, levels of detail and cages of the selected objects, made and proven
by the installed tools. The guide is docs/guides/blender.md."""
from . import operators, panel, presets, settings

# Blender 4.2 and later read blender_manifest.toml, earlier ones this.
bl_info = {
    "name": "Bounding Proxies",
    "description": "Collision bodies, hulls, occluders, levels and cages that enclose objects",
    "author": "The authors of Bounding Proxies",
    "version": (0, 3, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Proxy",
    "category": "Object",
}


def register() -> None:
    for module in (settings, operators, presets, panel):
        module.register()


def unregister() -> None:
    for module in (panel, presets, operators, settings):
        module.unregister()
