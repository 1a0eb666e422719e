#!/usr/bin/env python3
"""Three links of a robot as OBJ, metres, z up: links.py FOLDER
base:    a plate, a column and two boxes: four convex parts
forearm: a bent tube, open at its ends, with a convex flange: one part that is convex, and one that is not
cup:     a turned shell whose wall is 2 % of its radius
The same bytes on every machine."""
import math
import sys
from pathlib import Path


class Link:
    def __init__(self):
        self.points, self.faces = [], []

    def add(self, points, faces):
        base = len(self.points) + 1
        self.points += points
        self.faces += [[base + i for i in face] for face in faces]

    def box(self, lo, hi):
        self.add([[(lo, hi)[i >> k & 1][k] for k in range(3)] for i in range(8)],
                 [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])

    def rings(self, rings, closed):
        """Quads between rings of as many points; a row that is not closed ends with polygons."""
        n = len(rings[0])
        faces = []
        for r in range(len(rings) if closed else len(rings) - 1):
            a, b = r * n, (r + 1) % len(rings) * n
            faces += [(a + i, a + (i + 1) % n, b + (i + 1) % n, b + i) for i in range(n)]
        if not closed:
            faces += [tuple(reversed(range(n))), tuple(range((len(rings) - 1) * n, len(rings) * n))]
        self.add([p for ring in rings for p in ring], faces)

    def write(self, path):
        lines = ["v %.6f %.6f %.6f" % tuple(p) for p in self.points] + ["f " + " ".join(map(str, f)) for f in self.faces]
        path.write_text("\n".join(lines) + "\n")


def ring(radius, z, n):
    return [[radius * math.cos(2 * math.pi * i / n), radius * math.sin(2 * math.pi * i / n), z] for i in range(n)]


def base():
    link = Link()
    link.box((-0.2, -0.15, 0), (0.2, 0.15, 0.03))
    link.rings([ring(0.06, 0.03, 24), ring(0.05, 0.3, 24)], False)
    link.box((-0.05, 0.08, 0.2), (0.05, 0.13, 0.28))
    link.box((-0.05, -0.13, 0.2), (0.05, -0.08, 0.28))
    return link


def forearm():
    link = Link()
    profile = [(0.04, 0.03), (0.03, 0.03)]  # radii: outer, inner; along an arc of 90 degrees
    rows = []
    for radius in (profile[0][0], profile[1][1]):
        row = []
        for j in range(13):
            turn = math.pi / 2 * j / 12
            row.append([[(0.2 - radius * math.cos(2 * math.pi * i / 16)) * math.cos(turn), radius * math.sin(2 * math.pi * i / 16),
                         (0.2 - radius * math.cos(2 * math.pi * i / 16)) * math.sin(turn)] for i in range(16)])
        rows.append(row)
    link.rings(rows[0] + list(reversed(rows[1])), True)
    link.box((0.14, -0.06, -0.05), (0.26, 0.06, -0.02))
    return link


def cup():
    link = Link()
    n, wall = 32, 0.002
    outer = [(0.08 + 0.02 * math.sin(math.pi * i / 8), 0.12 * i / 8) for i in range(9)]
    inner = [(r - wall, max(z, wall)) for r, z in reversed(outer)]
    link.rings([ring(r, z, n) for r, z in outer + inner], False)
    return link


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for make in (base, forearm, cup):
        make().write(folder / (make.__name__ + ".obj"))
