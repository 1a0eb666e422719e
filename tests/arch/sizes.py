#!/usr/bin/env python3
"""Holds the sizes that the house keeps to: lines of a file, of a function's body and of a class, files of a folder.
    tests/arch/sizes.py [ROOT]
Prints what is larger; exit status 1 if there is any. A function's body begins where its signature ends; the style (clang-format)
decides what is one. A class has the lines of its definition, and those of its functions that are defined outside of it."""
import re
import subprocess
import sys
from collections import Counter, defaultdict
from pathlib import Path

FILE, FUNCTION, CLASS, FOLDER = 400, 40, 150, 27
# A kernel and what it calls on the device belong in one file, and in one piece: registers and inlining depend on it.
LONG_FILES = {"gpu/kernels/bit_kernels.cu", "gpu/kernels/row_kernels.cu", "tests/backend/hierarchical_kernels.cu"}
TABLES = {"text_of", "with_fields"}  # one case after the other, no step depends on another
# One file for each behaviour; pages that are only added to; decisions, which are found by their numbers.
FULL_FOLDERS = {"tests/golden/cases", "docs/lab", "docs/decisions"}
# Classes that are larger, with the lines that they may have. The list may only shrink.
LARGE_CLASSES = {
    "Ac3dText": 169, "Args": 260, "BoxTree": 212, "BrickReader::State": 207, "CheckReport": 185, "CollapsePlanner": 198,
    "ColorGrid": 234, "ConvexCover": 172, "EditCheck": 165, "EnclosedTriangles": 180, "EnclosedVoxels": 192,
    "FanFit": 200, "GltfCopy": 233, "GltfDocument": 419, "GltfMaterials": 160, "HalfEdgeMesh": 311, "HiddenCheck": 200,
    "InsideCells": 174, "JointFit": 268, "LeafMaker": 157, "LeafMesh": 225, "LeakSearch": 302, "LevelSearch": 187,
    "LiveClosing": 153, "OffSource": 154, "OrientedDilation": 351, "Parts": 482, "PlySource": 215, "ProxyEditor": 232,
    "Quickhull": 195, "RowTables": 217, "RunDecoder": 151, "SceneEye": 201, "Server::State": 167, "Session": 327,
    "SolidCell": 180, "Steps": 154, "TextScanner": 276, "Tightener": 259, "TileFill": 155, "TileMaker": 246,
    "TileTree": 163, "TilesetFolder": 179, "TriangleBvh": 151, "VisualTiles": 175, "Walls": 190,
}
SOURCES = (".h", ".cpp", ".cu", ".cuh", ".py", ".sh", ".cmake")


def functions(lines):
    """Name, first line and lines of each function of a C++ file: indented by at most one class."""
    for at, line in enumerate(lines):
        if not line.endswith("{") or line.lstrip().startswith(("//", "}")):
            continue
        first = at
        while first > 0 and lines[first - 1].strip() and not re.search(r"[;{}:]$|^\s*(//|#)", lines[first - 1]):
            first -= 1
        signature = " ".join(part.strip() for part in lines[first:at + 1])
        indent = re.match(r" *", lines[first]).group()
        name = re.search(r"(?!decltype)\b([A-Za-z_]\w*|operator\S+)\(", signature)
        if len(indent) > 2 or not name or re.match(r"(namespace|class|struct|enum|extern|if|for|while|switch|do|else)\b", signature):
            continue
        if re.search(r"\]\s*\(|=\s*\{$", signature):  # a lambda, a list
            continue
        end = next((i for i in range(at + 1, len(lines)) if lines[i].startswith(indent + "}")), len(lines) - 1)
        yield name.group(1), at + 1, end - at + 1


def classes(files):
    """Name, file, line and lines of each class. `files`: the lines of each file, by name."""
    found = defaultdict(list)
    for name, lines in files.items():
        for at, line in enumerate(lines):
            begin = re.match(r"( *)(?:template .*> )?(?:class|struct) ([A-Za-z_][\w:]*)[^;=()]*\{$", line)
            if begin:
                end = next(i for i in range(at + 1, len(lines)) if lines[i].startswith(begin.group(1) + "}"))
                found[begin.group(2).split("::")[-1]].append([begin.group(2), name, at + 1, end - at + 1])
    for name, lines in files.items():
        for at, line in enumerate(lines):
            if not line.endswith("{") or line.startswith((" ", "}", "//")):
                continue
            first = at
            while first > 0 and lines[first - 1].strip() and not re.search(r"[;{}:]$|^\s*(//|#)", lines[first - 1]):
                first -= 1
            signature = " ".join(part.strip() for part in lines[first:at + 1])
            owner = re.search(r"(?:^|[\s*&])(?:\w+::)*(\w+)(?:<[^<>()]*>)?::(?:~?\w+|operator\S+)\(", signature)
            if not owner or re.match(r"(namespace|class|struct|enum|extern)\b", signature):
                continue
            end = next((i for i in range(at + 1, len(lines)) if lines[i].startswith("}")), len(lines) - 1)
            near = [c for c in found[owner.group(1)] if c[1] == name] or [
                c for c in found[owner.group(1)] if Path(c[1]).with_suffix("") == Path(name).with_suffix("")] or [
                c for c in found[owner.group(1)] if Path(c[1]).parent == Path(name).parent] or found[owner.group(1)]
            if near:
                near[0][3] += end - first + 1
    return [entry for entries in found.values() for entry in entries]


def large_classes(files):
    """What is wrong with the sizes of classes."""
    largest = Counter()
    for name, file, line, size in classes(files):
        largest[name] = max(largest[name], size)
        most = LARGE_CLASSES.get(name, CLASS)
        if size > most:
            yield f"{file}:{line}: {name} has {size} lines with its functions, {most} at most"
    for name in LARGE_CLASSES:
        if largest[name] <= CLASS:
            yield f"tests/arch/sizes.py: {name} is no longer large; take it out of LARGE_CLASSES"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent.parent)
    run = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=False)
    files = [name for name in run.stdout.split("\n") if name and (root / name).exists()]
    if not files:
        print("SKIPPED: no clone of the repository")
        return 0
    found, checked, product = [], 0, {}
    for name in files:
        if not name.endswith(SOURCES):
            continue
        lines = (root / name).read_text(encoding="utf-8").rstrip("\n").split("\n")
        if len(lines) > FILE and name not in LONG_FILES:
            found.append(f"{name}: {len(lines)} lines, {FILE} at most")
        if not name.startswith("tests/") and name.endswith((".h", ".cpp", ".cu", ".cuh")):
            product[name] = lines
        if name.startswith("tests/") or not name.endswith((".h", ".cpp")):
            continue
        for function, line, size in functions(lines):
            checked += 1
            if size > FUNCTION and function not in TABLES:
                found.append(f"{name}:{line}: {function}() has {size} lines, {FUNCTION} at most")
    found += large_classes(product)
    for folder, count in Counter(str(Path(name).parent) for name in files).items():
        if count > FOLDER and folder not in FULL_FOLDERS:
            found.append(f"{folder}: {count} files, {FOLDER} at most")
    print("\n".join(found) if found else f"{checked} functions in {len(files)} files are small")
    return 1 if found or checked < 1000 else 0


if __name__ == "__main__":
    sys.exit(main())
