"""What the panel asks for, and the preferences of the add-on."""
from __future__ import annotations

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from .commands import Choices

AXES = [("auto", "Automatic", "The axis across which the object is its own mirror image, if it has one"),
        ("x", "X", "Both halves across x mirror each other"), ("y", "Y", "Both halves across y mirror each other"),
        ("z", "Z", "Both halves across z mirror each other"), ("off", "Off", "The halves may differ")]

class BoundingProxiesSettings(bpy.types.PropertyGroup):
    """The settings of a scene. They are saved with the file."""

    collision_faces: IntProperty(name="Faces", default=500, min=0, soft_max=20000,
                                 description="Most triangles of the body, and of all hulls together. 0: the tool chooses, 5000 at most")
    hulls: IntProperty(name="Hulls", default=0, min=0, max=4096, description="Most convex hulls. 0: 32 or 64, or one for each part")
    hull_corners: IntProperty(name="Corners", default=64, min=8, max=64, description="Most corners of a hull: 64 for PhysX, 32 for MJX")
    engine: EnumProperty(name="Names for", items=[
        ("PLAIN", "No engine", "truck_collision, truck_occluder"),
        ("GODOT", "Godot", "truck-colonly, truck-occonly: Godot imports them as a body and an occluder"),
        ("UNITY", "Unity", "truck_Collider")], description="How the body and the occluder are called. Convex hulls have Unreal's names")
    occluder_faces: IntProperty(name="Faces", default=0, min=0, soft_max=5000, description="Most triangles. 0: 100, or 24 for each part")
    level_faces: StringProperty(name="Faces", default="4000,1000,250",
                                description="Triangles of each level, finest first: 4000,1000,250 or 50%,10%. Empty: from the objects")
    level_mode: EnumProperty(name="Mode", items=[("bounding", "Enclose", "Each level encloses the objects"),
                                                 ("fit", "Fit", "Each level follows the objects, and need not enclose them")])
    appearance: EnumProperty(name="Looks", items=[
        ("auto", "Automatic", "A texture if the materials have images, else colours"),
        ("texture", "Texture", "An image of what the materials show"),
        ("full", "Full", "Images of colour, normals, roughness, metal and light"),
        ("color", "Colours", "Colours of corners"), ("off", "None", "Neither")])
    cage_faces: IntProperty(name="Faces", default=1000, min=12, soft_max=10000, description="Most triangles of the cage, two for a quad")
    margin: FloatProperty(name="Margin", default=0.5, min=0, soft_max=10, subtype="PERCENTAGE",
                          description="Least distance from the cage to the objects, as a share of their diagonal")
    symmetry: EnumProperty(name="Symmetry", items=AXES, description="The axis across which both halves of the cage mirror each other")
    bind: BoolProperty(name="Bind", default=True, description="Add the modifier Mesh Deform to the objects, and bind them to the cage")
    precision: IntProperty(name="Precision", default=5, min=2, max=10,
                           description="Of Mesh Deform: higher values take more time and follow thin parts of the cage better")

    scale_kind: EnumProperty(name="Scale", items=[("AUTO", "Automatic", "The tool chooses, by the faces"), ("PERCENT", "Percent", "A share of the diagonal"),
                                                  ("LENGTH", "Length", "A length in the scene")],
                             description="Closing radius: gaps and holes narrower than about twice that are filled")
    scale_percent: FloatProperty(name="Scale", default=1, min=0, max=100, precision=2, subtype="PERCENTAGE",
                                 description="Closing radius, as a share of the objects' diagonal")
    scale_length: FloatProperty(name="Scale", default=0.1, min=0, subtype="DISTANCE", unit="LENGTH", description="Closing radius")
    grid_kind: EnumProperty(name="Voxels", items=[("AUTO", "Automatic", "The tool chooses"), ("RESOLUTION", "Resolution", "Voxels along the longest side"),
                                                  ("VOXEL", "Length", "The length of a voxel")], description="How fine the grid is")
    resolution: IntProperty(name="Resolution", default=256, min=8, max=16384, description="Voxels along the longest side of the objects")
    voxel: FloatProperty(name="Voxel", default=0.05, min=1e-6, precision=4, subtype="DISTANCE", unit="LENGTH",
                         description="The length of a voxel")
    check_after: BoolProperty(name="Prove results", default=True,
                              description="Run bpcheck on what lies in the scene when the result is there")

    def choices(self, kind: str, preferences: Preferences) -> Choices:
        """Returns the settings as the tools want them."""
        faces = {"COLLISION": self.collision_faces, "HULLS": self.collision_faces, "OCCLUDER": self.occluder_faces, "CAGE": self.cage_faces}.get(kind)
        scale = {"AUTO": "", "PERCENT": f"{self.scale_percent:.6g}%", "LENGTH": f"{self.scale_length:.9g}"}[self.scale_kind]
        grid = {"AUTO": [], "RESOLUTION": ["--resolution", str(self.resolution)], "VOXEL": ["--voxel", f"{self.voxel:.9g}"]}[self.grid_kind]
        return Choices(kind=kind, faces=self.level_faces.replace(" ", "") if faces is None else str(faces or ""), scale=scale, grid=grid,
                       hulls=self.hulls, hull_corners=self.hull_corners if self.hull_corners != 64 else 0, margin=f"{self.margin:.6g}%",
                       symmetry=self.symmetry, mode=self.level_mode, appearance=self.appearance, threads=preferences.threads,
                       memory=preferences.memory.strip())


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    folder: StringProperty(name="Folder of the tools", subtype="DIR_PATH", description="Where bplod and bpcheck are. Empty: on PATH")
    threads: IntProperty(name="Threads", default=0, min=0, max=1024, description="0: one for each core")
    memory: StringProperty(name="Memory", default="", description="Most memory of a tool, as 4G. Empty: a quarter of the machine's")

    def draw(self, context: bpy.types.Context) -> None:
        for name in ("folder", "threads", "memory"):
            self.layout.prop(self, name)


def preferences(context: bpy.types.Context) -> Preferences:
    return context.preferences.addons[__package__].preferences


def register() -> None:
    bpy.utils.register_class(BoundingProxiesSettings)
    bpy.utils.register_class(Preferences)
    bpy.types.Scene.bounding_proxies = PointerProperty(type=BoundingProxiesSettings)


def unregister() -> None:
    del bpy.types.Scene.bounding_proxies
    bpy.utils.unregister_class(Preferences)
    bpy.utils.unregister_class(BoundingProxiesSettings)
