#!/usr/bin/env python3
"""A small town with textures, as OBJ with materials and PNG images: houses with facades, tiled roofs, a paved square, and
letters that show when something is mirrored.
    samples/town.py FOLDER [HOUSES]        64 houses by default; 14 triangles each; y up
The same bytes on every machine."""
import random
import struct
import sys
import zlib
from pathlib import Path

LETTERS = {"B": "1110 1001 1110 1001 1110", "P": "1110 1001 1110 1000 1000", "F": "1111 1000 1110 1000 1000", "R": "1110 1001 1110 1010 1001"}


class Picture:
    def __init__(self, width, height, color):
        self.width, self.height = width, height
        self.rows = [[color] * width for _ in range(height)]

    def fill(self, x0, y0, x1, y1, color):
        for row in self.rows[max(0, y0):y1]:
            row[max(0, x0):x1] = [color] * (min(x1, self.width) - max(0, x0))

    def speckle(self, rand, amount):
        for row in self.rows:
            for x, color in enumerate(row):
                shade = 1 + amount * (rand.random() - .5)
                row[x] = tuple(max(0, min(255, int(c * shade))) for c in color)

    def write(self, path):
        raw = b"".join(b"\0" + bytes(c for color in row for c in color) for row in self.rows)
        chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)) +
                         chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def facade(rand, wall, letter):
    p = Picture(256, 256, wall)
    for y in range(0, 256, 8):  # courses of bricks
        p.fill(0, y, 256, y + 1, tuple(int(c * .8) for c in wall))
        for x in range((y // 8 % 2) * 8, 256, 16):
            p.fill(x, y, x + 1, y + 8, tuple(int(c * .8) for c in wall))
    for y in (20, 100):
        for x in (24, 100, 176):
            p.fill(x, y, x + 56, y + 60, (240, 240, 235))
            p.fill(x + 5, y + 5, x + 51, y + 55, (60, 80, 110))
            p.fill(x + 26, y + 5, x + 29, y + 55, (240, 240, 235))
    p.fill(30, 180, 80, 256, (90, 50, 30))  # door
    p.fill(110, 186, 240, 250, (250, 250, 250))  # sign
    for y, line in enumerate(LETTERS[letter].split()):
        for x, bit in enumerate(line):
            if bit == "1":
                p.fill(150 + 12 * x, 188 + 12 * y, 162 + 12 * x, 200 + 12 * y, (200, 30, 30))
    p.speckle(rand, .12)
    return p


def pattern(rand, base, dark, step):
    p = Picture(128, 128, base)
    for y in range(0, 128, step):
        p.fill(0, y, 128, y + 2, dark)
        for x in range((y // step % 2) * step // 2, 128, step):
            p.fill(x, y, x + 2, y + step, dark)
    p.speckle(rand, .25)
    return p


class Town:
    def __init__(self):
        self.points, self.places, self.faces = [], [], []

    def face(self, points, places, material):
        first, at = len(self.points) + 1, len(self.places) + 1
        self.points += points
        self.places += places
        self.faces.append((material, [(first + i, at + i) for i in range(len(points))]))

    def house(self, x, z, w, d, h, ridge, walls, roof):
        corners = [(x, z), (x, z + d), (x + w, z + d), (x + w, z)]
        for k in range(4):
            (ax, az), (bx, bz) = corners[k], corners[(k + 1) % 4]
            n = max(1, round((abs(bx - ax) + abs(bz - az)) / 9))
            self.face([(ax, 0, az), (bx, 0, bz), (bx, h, bz), (ax, h, az)], [(0, 0), (n, 0), (n, 1), (0, 1)], walls)
        m = z + d / 2
        for a, b in ((0, 1), (1, 0)):
            ends = (x, x + w) if a == 0 else (x + w, x)
            side = z + d if a == 0 else z
            self.face([(ends[0], h, side), (ends[1], h, side), (ends[1], h + ridge, m), (ends[0], h + ridge, m)],
                      [(0, 0), (w / 3, 0), (w / 3, 2), (0, 2)], roof)
        self.face([(x, h, z), (x, h, z + d), (x, h + ridge, m)], [(0, .6), (1, .6), (.5, .95)], walls)
        self.face([(x + w, h, z + d), (x + w, h, z), (x + w, h + ridge, m)], [(0, .6), (1, .6), (.5, .95)], walls)

    def write(self, folder, images):
        with open(folder / "town.mtl", "w", encoding="ascii") as out:
            for name, picture in images.items():
                picture.write(folder / f"{name}.png")
                out.write(f"newmtl {name}\nKd 0.6 0.6 0.6\nmap_Kd {name}.png\n")
        with open(folder / "town.obj", "w", encoding="ascii") as out:
            out.write("mtllib town.mtl\n")
            out.writelines("v %.4f %.4f %.4f\n" % p for p in self.points)
            out.writelines("vt %.4f %.4f\n" % p for p in self.places)
            for name in images:
                out.write(f"usemtl {name}\n")
                out.writelines("f " + " ".join("%d/%d" % c for c in face) + "\n" for m, face in self.faces if m == name)


def main():
    if {"-h", "--help"} & set(sys.argv[1:]):
        return print(__doc__)
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    folder, houses = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 64
    folder.mkdir(parents=True, exist_ok=True)
    rand = random.Random(3)
    walls = {"B": (190, 90, 70), "P": (205, 190, 150), "F": (150, 165, 185), "R": (225, 215, 205)}
    images = {f"facade_{k}": facade(rand, color, k) for k, color in walls.items()}
    images["tiles"] = pattern(rand, (170, 75, 50), (110, 45, 35), 16)
    images["slate"] = pattern(rand, (85, 90, 100), (50, 55, 65), 16)
    images["paving"] = pattern(rand, (150, 148, 140), (105, 103, 98), 32)
    town = Town()
    side = max(1, round(houses ** .5))
    for i in range(houses):
        x, z = i % side * 16, i // side * 20
        town.house(x + rand.uniform(0, 2), z + rand.uniform(0, 3), rand.uniform(9, 13), rand.uniform(9, 13), rand.uniform(6, 14),
                   rand.uniform(2, 5), "facade_" + rand.choice("BPFR"), rand.choice(("tiles", "slate")))
    w, d = side * 16 + 8, -(-houses // side) * 20 + 8
    square = [(-8, 0, -8), (-8, 0, d), (w, 0, d), (w, 0, -8)]
    town.face(square, [(0, 0), (0, d / 4), (w / 4, d / 4), (w / 4, 0)], "paving")
    low = [(x, -1, z) for x, _, z in square]
    for k in range(4):
        a, b = k, (k + 1) % 4
        town.face([square[b], square[a], low[a], low[b]], [(0, 0), (9, 0), (9, 1), (0, 1)], "paving")
    town.face(low[::-1], [(0, 0), (9, 0), (9, 9), (0, 9)], "paving")
    town.write(folder, images)
    print(f"{folder / 'town.obj'}: {sum(len(face) - 2 for _, face in town.faces)} triangles")


if __name__ == "__main__":
    main()
