#!/usr/bin/env python3
"""The picture of docs/architecture.md: the rooms of check_includes.cmake, each below all rooms that may include it.
    tests/arch/picture.py [--write] [ROOT]
Without --write: exit status 1 if docs/architecture.svg differs, if a room is not on the page, or if a type of TYPES is not
declared in its room. --write renews the picture."""
import re
import sys
from pathlib import Path

# The types that a room hands on, as far as they tell what flows.
TYPES = {
    "lib/core": "TriangleSource", "lib/grid": "BrickSource, BrickSink", "lib/store": "ResultStore, Scratch",
    "lib/geometry": "TriangleBvh", "lib/mesh": "LatticeMesh", "lib/surface": "SurfaceSource", "lib/enclosed": "Enclosed",
    "lib/device": "Backend", "lib/device/cpu": "CpuBackend", "lib/pass": "PassContext", "lib/hulls": "ConvexHull", "lib/fit": "FineFit",
    "lib/quads": "CellQuads", "lib/atlas": "Atlas", "lib/image": "Image", "lib/tileset": "Tileset", "lib/check": "CheckReport",
    "lib/deform": "Cage", "lib/live": "Design", "lib/levels": "LodLevel", "lib/closing": "ClosingParams", "lib/simplify": "SimplifyParams",
    "lib/tighten": "TightenParams", "lib/pass/mesh": "MeshParams", "lib/pass/color": "SceneColors", "lib/pass/bake": "SceneLooks",
    "lib/pass/leaf": "SceneLeaf", "lib/pass/hide": "HiddenVoxels", "lib/pass/close": "CloseOptions", "io/files": "OutputFile",
    "io/stream": "BrickReader, BrickWriter", "io/scene": "SceneFile", "io/gltf": "GltfDocument", "io/deform": "WeightReader",
    "io/tiles": "TilesetContents", "io/image": "EncodedImage", "tools/cli": "Args",
}
COLUMNS = {"lib": 0, "io": 1, "gpu": 1, "tools": 0, "samples": 0}
COLORS = {"lib": "#dcebf7", "io": "#e3f2df", "gpu": "#f7e6d4", "tools": "#f3e3f1", "samples": "#eeeeee"}
WIDTH, HEIGHT, ROW, GAP, LEFT = 142, 36, 66, 12, 14


def rooms_of(text):
    """Each room, and the rooms that it may include."""
    rules = dict(re.findall(r'^  "([^:"]+):([^"]*)"\)?$', text[:text.index("set(foreign")], re.M))
    rules.pop("tests")
    rooms = {}
    for room, may in rules.items():
        trees = tuple(m[:-1] for m in may.split() if m.endswith("/*"))
        rooms[room] = {r for r in rules if r != room and (r in may.split() or (trees and r.startswith(trees)))}
    return rooms


def above(rooms):
    """The row of each room, from 0 at the bottom: one more than that of the highest room that it may include."""
    rows = {}
    while len(rows) < len(rooms):
        ready = {r for r in rooms if r not in rows and all(m in rows for m in rooms[r])}
        if not ready:
            sys.exit("the rooms include each other in a ring: " + " ".join(r for r in rooms if r not in rows))
        rows.update({r: 1 + max((rows[m] for m in rooms[r]), default=-1) for r in ready})
    return rows


def below(rooms):
    """All that each room may include, directly or by way of another one."""
    found = {}
    for room in sorted(rooms, key=above(rooms).get):
        found[room] = rooms[room].union(*(found[m] for m in rooms[room]))
    return found


def needed(rooms, room, under):
    """What it may include, without what follows from another of these. Tools may include nearly all: only tools are shown."""
    may = {m for m in rooms[room] if m.startswith("tools") or not room.startswith(("tools", "samples")) or room == "tools/cli"}
    return {m for m in may if not any(m in under[o] for o in rooms[room])}


def places(rooms, rows):
    """The left upper corner of each box. In a row, boxes stand near to those below that they include."""
    at, top = {}, max(rows.values())
    widest = max(sum(COLUMNS[r.split("/")[0]] == 0 and rows[r] == n for r in rooms) for n in range(top + 1))
    for n in range(top + 1):
        for column in (0, 1):
            row = [r for r in rooms if rows[r] == n and COLUMNS[r.split("/")[0]] == column]
            mean = {r: sum(at[m][0] for m in rooms[r]) / max(len(rooms[r]), 1) for r in row}
            first = LEFT + (widest - len(row)) * (WIDTH + GAP) // 2 if column == 0 else LEFT + widest * (WIDTH + GAP) + 30
            for i, r in enumerate(sorted(row, key=lambda r: (mean[r], r))):
                at[r] = (first + i * (WIDTH + GAP), 10 + (top - n) * ROW)
    return at


def picture(rooms):
    rows, under = above(rooms), below(rooms)
    at = places(rooms, rows)
    right, bottom = max(x for x, _ in at.values()) + WIDTH + LEFT, max(y for _, y in at.values()) + HEIGHT + 10
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{right}" height="{bottom}" font-family="sans-serif" text-anchor="middle">',
           f'<rect width="{right}" height="{bottom}" fill="white"/>']
    for r in sorted(rooms):
        for m in sorted(needed(rooms, r, under)):
            (x, y), (u, v) = at[r], at[m]
            x, u = x + WIDTH // 2, u + WIDTH // 2
            out.append(f'<path d="M{x} {y + HEIGHT} C{x} {y + HEIGHT + 40} {u} {v - 40} {u} {v}" fill="none" stroke="#b8b8b8"/>')
    for r in sorted(rooms):
        x, y = at[r]
        name, types = r, TYPES.get(r, "")
        out.append(f'<rect x="{x}" y="{y}" width="{WIDTH}" height="{HEIGHT}" rx="4" fill="{COLORS[r.split("/")[0]]}" stroke="#707070"/>')
        out.append(f'<text x="{x + WIDTH // 2}" y="{y + (15 if types else 22)}" font-size="13">{name}</text>')
        if types:
            out.append(f'<text x="{x + WIDTH // 2}" y="{y + 30}" font-size="10.5" fill="#505050">{types}</text>')
    return "\n".join(out) + "\n</svg>\n"


def faults(root, rooms, drawn):
    svg = root / "docs/architecture.svg"
    if not svg.exists() or svg.read_text(encoding="utf-8") != drawn:
        yield "docs/architecture.svg is not that of check_includes.cmake: run tests/arch/picture.py --write"
    page = (root / "docs/architecture.md").read_text(encoding="utf-8")
    yield from (f"docs/architecture.md: does not say what `{r}` holds" for r in rooms if f"`{r}`" not in page)
    for room, types in TYPES.items():
        text = "".join(p.read_text(encoding="utf-8") for p in sorted((root / room).glob("*.h")))
        for name in types.split(", "):
            if not re.search(rf"\b(class|struct) {name}\b", text):
                yield f"{Path(__file__).name}: {room} declares no {name}"


def main():
    root = Path(next((a for a in sys.argv[1:] if a != "--write"), Path(__file__).resolve().parent.parent.parent))
    rooms = rooms_of((root / "tests/arch/check_includes.cmake").read_text(encoding="utf-8"))
    drawn = picture(rooms)
    if "--write" in sys.argv:
        (root / "docs/architecture.svg").write_text(drawn, encoding="utf-8")
    found = list(faults(root, rooms, drawn))
    print("\n".join(found) or f"{len(rooms)} rooms are as the picture shows them")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
