"""Which tool makes what, and with which options. Nothing here touches Blender's data."""
from __future__ import annotations

import os
import re
import shutil
from dataclasses import dataclass, field
from pathlib import Path

from .jobs import ToolError


@dataclass
class Choices:
    """What the panel asks for. Lengths are text for the tools: "2%" or "0.5"; an empty text leaves the choice to the tool."""

    kind: str
    faces: str = ""
    scale: str = ""
    grid: list[str] = field(default_factory=list)  # --resolution N or --voxel LENGTH
    hulls: int = 0
    hull_corners: int = 0
    margin: str = ""
    symmetry: str = "auto"
    mode: str = "bounding"
    appearance: str = "auto"
    threads: int = 0
    memory: str = ""


PROFILES = {"COLLISION": "collision", "HULLS": "collision", "OCCLUDER": "occluder", "LEVELS": "gltf", "CAGE": "cage"}


def tool_path(name: str, folder: str) -> str:
    """Returns the path of a tool: of the folder in the preferences, if there is one, else of PATH."""
    file = name + (".exe" if os.name == "nt" else "")
    if folder:
        path = Path(folder) / file
        if not path.is_file():
            raise ToolError(f"{name} is not in {folder}; correct the folder in the preferences of the add-on")
        return str(path)
    found = shutil.which(name)
    if not found:
        raise ToolError(f"{name} is not installed, or not on PATH; install the tools, or name their folder in the preferences of the add-on")
    return found


def safe_name(name: str) -> str:
    """Returns the name of an object as a file may have it everywhere."""
    return re.sub(r"[^\w-]", "_", name).strip("_") or "scene"


def has_looks(kind: str) -> bool:
    """True for what needs materials: levels show them, and glass is no wall of an occluder. They are written as OBJ, other scenes as PLY."""
    return kind in ("LEVELS", "OCCLUDER")


def scene_file(kind: str, name: str) -> str:
    return name + (".obj" if has_looks(kind) else ".ply")


def make_command(choices: Choices, name: str) -> list[str]:
    """Returns bplod and its arguments. Results go to the folder `made`."""
    words = ["bplod", scene_file(choices.kind, name), "--up", "z", "--profile", PROFILES[choices.kind]]
    for option, value in (("--faces", choices.faces), ("--scale", choices.scale)):
        if value and not (choices.kind == "CAGE" and option == "--scale"):
            words += [option, value]
    words += choices.grid
    if choices.kind == "HULLS" and choices.hulls:
        words += ["--hulls", str(choices.hulls)]
    if choices.kind == "HULLS" and choices.hull_corners:
        words += ["--hull-corners", str(choices.hull_corners)]
    if choices.kind == "CAGE":
        words += ["--symmetry", choices.symmetry] + (["--margin", choices.margin] if choices.margin else [])
    if choices.kind == "LEVELS":
        words += ["--mode", choices.mode, "--appearance", choices.appearance]
    # Blender has 32-bit floats, as engines have. Far from the origin the result becomes an object with a location.
    return words + ["--origin", "auto", "-o", "made"]


def check_command(kind: str, mode: str, margin: str) -> list[str]:
    """Returns bpcheck and its arguments for a proxy of this kind."""
    if kind == "LEVELS" and mode == "fit":
        return ["bpcheck", "proxy.ply"]
    question = {"HULLS": ["--convex"], "OCCLUDER": ["--inside"]}.get(kind, ["--margin", margin] if margin else [])
    return ["bpcheck"] + question + [scene_file(kind, "scene"), "proxy.ply"]


def resources(choices: Choices) -> list[str]:
    """Returns the options that decide how a run takes place, and no byte of its result."""
    words = ["--progress", "json"]
    if choices.threads:
        words += ["--threads", str(choices.threads)]
    if choices.memory:
        words += ["--memory", choices.memory]
    return words


def table(text: str) -> list[dict[str, str]]:
    """Reads bplod's list of results: a line with the names of the columns, and a line for each file."""
    lines = [line.split("\t") for line in text.splitlines() if line]
    return [dict(zip(lines[0], line)) for line in lines[1:]]
