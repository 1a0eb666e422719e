#!/usr/bin/env python3
"""Scenes with images on them, as OBJ, MTL and PNG; y is up: painted.py FOLDER. The same bytes on every machine.
What an eye misses first when they are simplified: windows that smear, stripes that bend, borders of materials that fray."""
import math
import random
import struct
import sys
import zlib
from pathlib import Path


def png(path, side, color):
    """Writes an image; color(x, y) gives three bytes for places from 0 to 1, from the upper left."""
    rows = b"".join(b"\0" + b"".join(bytes(color((x + .5) / side, (y + .5) / side)) for x in range(side)) for y in range(side))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def windows(u, v):
    inside = .2 < u * 4 % 1 < .8 and .25 < v * 4 % 1 < .8
    return (50, 70, 110) if inside else (205, 190, 165)


def bricks(u, v):
    row = int(v * 16)
    joint = (u * 8 + row % 2 * .5) % 1 < .06 or v * 16 % 1 < .12
    return (170, 165, 160) if joint else (150 + row * 5 % 30, 70, 55)


def wood(u, v):
    grain = math.sin(60 * v + 4 * math.sin(6 * u)) * .5 + .5
    return (int(130 + 60 * grain), int(85 + 40 * grain), int(45 + 25 * grain))


def stripes(u, v):
    return (190, 40, 40) if int(v * 12) % 2 else (235, 230, 215)


def checks(u, v):
    return (240, 240, 235) if (int(u * 16) + int(v * 16)) % 2 else (40, 50, 60)


def fields(u, v):
    cell = random.Random(int(u * 6) * 31 + int(v * 6)).random()
    road = abs(u - .5 - .1 * math.sin(6 * v)) < .02
    return (90, 90, 95) if road else (int(90 + 90 * cell), int(120 + 60 * cell), int(50 + 40 * cell))


IMAGES = {"windows": windows, "bricks": bricks, "wood": wood, "stripes": stripes, "checks": checks, "fields": fields}


class Mesh:
    def __init__(self):
        self.lines, self.points, self.places = [], 0, 0

    def use(self, material):
        self.lines.append(f"usemtl {material}")
        return self

    def sheet(self, at, cells_u, cells_v, times=(1, 1)):
        """A grid of quads; at(u, v) gives a point for places from 0 to 1."""
        for j in range(cells_v + 1):
            for i in range(cells_u + 1):
                u, v = i / cells_u, j / cells_v
                self.lines.append("v {:.7g} {:.7g} {:.7g}".format(*at(u, v)))
                self.lines.append(f"vt {u * times[0]:.7g} {v * times[1]:.7g}")
        at_row = cells_u + 1
        for j in range(cells_v):
            for i in range(cells_u):
                corners = [j * at_row + i, j * at_row + i + 1, (j + 1) * at_row + i + 1, (j + 1) * at_row + i]
                self.lines.append("f " + " ".join(f"{self.points + c + 1}/{self.places + c + 1}" for c in corners))
        self.points += at_row * (cells_v + 1)
        self.places += at_row * (cells_v + 1)
        return self

    def wall(self, a, b, low, high, cells=(1, 1), times=(1, 1)):
        return self.sheet(lambda u, v: (a[0] + u * (b[0] - a[0]), low + v * (high - low), a[1] + u * (b[1] - a[1])), *cells, times)

    def block(self, lo, hi, cells=1, times=(1, 1)):
        """Four walls and a roof."""
        corners = [(lo[0], hi[2]), (hi[0], hi[2]), (hi[0], lo[2]), (lo[0], lo[2])]
        for k in range(4):
            self.wall(corners[k], corners[(k + 1) % 4], lo[1], hi[1], (cells, cells), times)
        return self.sheet(lambda u, v: (lo[0] + u * (hi[0] - lo[0]), hi[1], hi[2] + v * (lo[2] - hi[2])), cells, cells, times)

    def lathe(self, radius, height, sides, rings, times=(1, 1)):
        """Turned around y; radius(v) from bottom to top."""
        return self.sheet(lambda u, v: (radius(v) * math.cos(2 * math.pi * u), height * v, -radius(v) * math.sin(2 * math.pi * u)),
                          sides, rings, times)

    def write(self, folder, name):
        (folder / (name + ".obj")).write_text("mtllib painted.mtl\n" + "\n".join(self.lines) + "\n")


def house():
    m = Mesh().use("windows").block((0, 0, 0), (6, 4, 8), 12).use("bricks")
    for side in (-1, 1):
        m.sheet(lambda u, v: (3 + side * 3.6 * (1 - v), 3.8 + 2.4 * v, (8.4 - 8.8 * u) if side > 0 else (-.4 + 8.8 * u)), 16, 8, (3, 1))
    return m.block((1, 4, 1), (1.8, 7, 1.8), 2)


def towers():
    m, chance = Mesh().use("fields"), random.Random(5)
    m.sheet(lambda u, v: (40 * u, 0, 40 - 40 * v), 24, 24)
    for i in range(5):
        for j in range(5):
            high = 4 + 14 * chance.random()
            m.use(chance.choice(["windows", "bricks"])).block((2 + 8 * i, 0, 2 + 8 * j), (6 + 8 * i, high, 6 + 8 * j), 5, (1, round(high / 4)))
    return m


def hills():
    return Mesh().use("fields").sheet(lambda u, v: (20 * u, 2 * math.sin(7 * u) * math.cos(5 * v) + .3 * math.sin(31 * u + 17 * v), 20 - 20 * v), 90, 90)


def vase():
    return Mesh().use("stripes").lathe(lambda v: .5 + .35 * math.sin(5 * v) + .1 * v, 3, 96, 64)


def ball():
    m = Mesh().use("checks")
    return m.sheet(lambda u, v: (math.sin(math.pi * v) * math.cos(2 * math.pi * u), -math.cos(math.pi * v), -math.sin(math.pi * v) * math.sin(2 * math.pi * u)), 96, 48)


def table():
    m = Mesh().use("wood").block((0, 2, 0), (4, 2.2, 3), 10)
    for x, z in ((.1, .1), (3.6, .1), (.1, 2.6), (3.6, 2.6)):
        m.block((x, 0, z), (x + .3, 2, z + .3), 3)
    return m.use("stripes").sheet(lambda u, v: (1 + 2 * u, 2.22 + .04 * math.sin(9 * u), 2.2 - 1.4 * v), 16, 12)


def barrels():
    m = Mesh()
    for i in range(4):
        radius = lambda v: .8 + .2 * math.sin(math.pi * v)
        m.use("wood" if i % 2 else "stripes")
        m.sheet(lambda u, v: (2.2 * i + radius(v) * math.cos(2 * math.pi * u), 2.4 * v, -radius(v) * math.sin(2 * math.pi * u)), 40, 16, (2, 1))
    return m


def pipe():
    m = Mesh().use("checks")
    def at(u, v):
        a, b = 3 * math.pi * u, 2 * math.pi * v
        r = 3 + .5 * math.cos(b)
        return (r * math.cos(a), .8 * a + .5 * math.sin(b), r * math.sin(a))
    return m.sheet(at, 160, 16, (12, 1))


SCENES = {"house": house, "towers": towers, "hills": hills, "vase": vase, "ball": ball, "table": table, "barrels": barrels, "pipe": pipe}

if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, color in IMAGES.items():
        png(folder / (name + ".png"), 256, color)
    (folder / "painted.mtl").write_text("".join(f"newmtl {name}\nKd 1 1 1\nmap_Kd {name}.png\n" for name in IMAGES))
    for name, make in SCENES.items():
        make().write(folder, name)
