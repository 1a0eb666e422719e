#!/usr/bin/env python3
"""Scenes of 4 to 4,000 triangles for the table of quality, as OBJ; y is up: scenes.py FOLDER [NAME...]. The same bytes on every machine.
Each scene stands for a kind that levels are made of: plates, bars, shells, parts that touch, parts that are apart, curved bodies."""
import math
import random
import sys
from pathlib import Path


class Mesh:
    def __init__(self):
        self.points, self.faces = [], []

    def add(self, points, faces):
        base = len(self.points)
        self.points += points
        self.faces += [tuple(base + i for i in face) for face in faces]
        return self

    def box(self, lo, hi):
        return self.prism([(lo[0], lo[2]), (lo[0], hi[2]), (hi[0], hi[2]), (hi[0], lo[2])], lo[1], hi[1])

    def prism(self, outline, low, high):
        """A polygon in x and z, lifted from `low` to `high`."""
        n = len(outline)
        points = [(x, y, z) for y in (low, high) for x, z in outline]
        sides = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
        return self.add(points, [tuple(range(n - 1, -1, -1)), tuple(range(n, 2 * n)), *sides])

    def rings(self, rings, closed, caps=True):
        """Rings of equally many points, joined by quads; closed: the last one to the first."""
        n, count = len(rings[0]), len(rings)
        faces = [(r * n + i, r * n + (i + 1) % n, (r + 1) % count * n + (i + 1) % n, (r + 1) % count * n + i)
                 for r in range(count if closed else count - 1) for i in range(n)]
        if caps and not closed:
            faces += [tuple(range(n - 1, -1, -1)), tuple(range((count - 1) * n, count * n))]
        return self.add([p for ring in rings for p in ring], faces)

    def lathe(self, profile, sides, caps=True):
        """Radii and heights, turned around y."""
        turn = [2 * math.pi * i / sides for i in range(sides)]
        return self.rings([[(r * math.cos(a), y, -r * math.sin(a)) for a in turn] for r, y in profile], False, caps)

    def tube(self, path, radius, sides, closed=False):
        """A round bar along a path of points."""
        rings = []
        for i, p in enumerate(path):
            a, b = path[i - 1 if closed or i > 0 else 0], path[(i + 1) % len(path) if closed or i + 1 < len(path) else i]
            along = unit([y - x for x, y in zip(a, b)])
            side = unit(cross(along, (0, 1, 0) if abs(along[1]) < .9 else (1, 0, 0)))
            other = cross(along, side)
            rings.append([tuple(c + radius * (math.cos(t) * s + math.sin(t) * o) for c, s, o in zip(p, side, other))
                          for t in (2 * math.pi * k / sides for k in range(sides))])
        return self.rings(rings, closed)

    def grid(self, height, cells, size):
        """A sheet over x and z; height(x, z)."""
        at = [size * i / cells for i in range(cells + 1)]
        faces = [(i * (cells + 1) + j, i * (cells + 1) + j + 1, (i + 1) * (cells + 1) + j + 1, (i + 1) * (cells + 1) + j)
                 for i in range(cells) for j in range(cells)]
        return self.add([(x, height(x, z), z) for x in at for z in at], faces)

    def turned(self, degrees):
        """Around x, then y: off the axes."""
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        self.points = [(x * c + z * s, y, z * c - x * s) for x, y, z in ((x, y * c - z * s, y * s + z * c) for x, y, z in self.points)]
        return self

    def write(self, path):
        lines = ["v {:.9g} {:.9g} {:.9g}\n".format(*p) for p in self.points]
        lines += ["f " + " ".join(str(i + 1) for i in face) + "\n" for face in self.faces]
        path.write_text("".join(lines))


def unit(v):
    n = math.sqrt(sum(x * x for x in v)) or 1
    return [x / n for x in v]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def circle(n, radius=1.0, at=(0.0, 0.0)):
    return [(at[0] + radius * math.sin(2 * math.pi * i / n), at[1] + radius * math.cos(2 * math.pi * i / n)) for i in range(n)]


def tetrahedron():
    return Mesh().add([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])


def cube(degrees=0):
    return Mesh().box((0, 0, 0), (1, 1, 1)).turned(degrees)


def roof():
    return Mesh().add([(0, 0, 0), (8, 0, 0), (8, 3, 3), (0, 3, 3), (8, 0, 6), (0, 0, 6)], [(0, 3, 2, 1), (3, 5, 4, 2)])


def tent():
    return Mesh().add([(0, 0, 0), (6, 0, 0), (6, 2, 2), (0, 2, 2), (6, 0, 4), (0, 0, 4)], [(0, 3, 2, 1), (3, 5, 4, 2), (0, 5, 3)])


def crossed_sheets():
    return Mesh().add([(-1, 0, 0), (1, 0, 0), (1, 2, 0), (-1, 2, 0), (0, 0, -1), (0, 0, 1), (0, 2, 1), (0, 2, -1)], [(0, 1, 2, 3), (4, 5, 6, 7)]).turned(15)


def l_shape():
    return Mesh().prism([(0, 0), (0, 3), (1, 3), (1, 1), (3, 1), (3, 0)], 0, 1)


def u_shape():
    return Mesh().prism([(0, 0), (0, 4), (1, 4), (1, 1), (3, 1), (3, 4), (4, 4), (4, 0)], 0, 1.5)


def house():
    mesh = Mesh().box((-5, 0, -4), (5, 5, 4)).prism([(-5.5, -4.5), (-5.5, 4.5), (5.5, 4.5), (5.5, -4.5)], 5, 5.3)
    mesh.add([(-5.5, 5.3, -4.5), (5.5, 5.3, -4.5), (5.5, 5.3, 4.5), (-5.5, 5.3, 4.5), (-5.5, 8.5, 0), (5.5, 8.5, 0)],
             [(0, 1, 2, 3), (0, 4, 5, 1), (3, 2, 5, 4), (0, 3, 4), (1, 5, 2)])
    return mesh.box((2, 5, -2), (3, 9.5, -1)).box((-1, 0, 4), (1, 2.5, 6))


def houses():
    mesh, rng = Mesh(), random.Random(3)
    for i in range(5):
        for j in range(4):
            w, h = rng.uniform(3, 6), rng.uniform(3, 12)
            mesh.box((10 * i, 0, 10 * j), (10 * i + w, h, 10 * j + rng.uniform(3, 6)))
    return mesh


def tower():
    mesh = Mesh()
    for i in range(10):
        mesh.box((-5 + .3 * i, 3 * i, -5 + .3 * i), (5 - .3 * i, 3 * i + 2.6, 5 - .3 * i)).box((-2, 3 * i + 2.6, -2), (2, 3 * i + 3, 2))
    return mesh


def stair():
    mesh = Mesh()
    for i in range(12):
        mesh.box((0, .18 * i, .28 * i), (1.2, .18 * (i + 1), .28 * (i + 1)))
    return mesh


def open_stair():
    mesh = Mesh()
    for i in range(12):
        mesh.box((0, .18 * i, .28 * i), (1.2, .18 * i + .04, .28 * i + .3))
    return mesh.tube([(0, -.1, 0), (0, 2.1, 3.4)], .05, 6).tube([(1.2, -.1, 0), (1.2, 2.1, 3.4)], .05, 6)


def spiral_stair():
    mesh = Mesh().lathe([(.1, 0), (.1, 4)], 12)
    for i in range(20):
        a = math.radians(18 * i)
        b = a + math.radians(17)
        mesh.prism([(0, 0), (math.sin(a), math.cos(a)), (math.sin(b), math.cos(b))], .2 * i, .2 * i + .05)
    return mesh


def chair():
    mesh = Mesh().box((-.22, .44, -.22), (.22, .48, .22))
    for x in (-.2, .2):
        mesh.box((x - .02, 0, .16), (x + .02, .44, .2)).box((x - .02, 0, -.2), (x + .02, .95, -.16))
    for y in (.6, .72, .84):
        mesh.box((-.18, y, -.19), (.18, y + .06, -.17))
    return mesh.box((-.18, .2, .17), (.18, .23, .19))


def table():
    mesh = Mesh().box((-.8, .72, -.45), (.8, .76, .45))
    for x in (-.72, .72):
        for z in (-.37, .37):
            mesh.box((x - .03, 0, z - .03), (x + .03, .72, z + .03))
    return mesh


def round_table():
    return Mesh().lathe([(.6, .7), (.6, .74)], 48).lathe([(.05, .05), (.05, .7)], 16).lathe([(.3, 0), (.3, .05)], 32)


def shelf():
    mesh = Mesh().box((0, 0, 0), (.03, 2, .4)).box((1, 0, 0), (1.03, 2, .4)).box((0, 0, -.01), (1.03, 2, 0))
    rng = random.Random(5)
    for i in range(6):
        mesh.box((.03, .38 * i, 0), (1, .38 * i + .03, .4))
        x = .05
        while x < .9:
            w = rng.uniform(.02, .06)
            mesh.box((x, .38 * i + .03, .02), (x + w, .38 * i + rng.uniform(.2, .3), .3))
            x += w + rng.choice([.002, .002, .1])
    return mesh


def fence(pickets=20):
    mesh = Mesh().box((0, .3, 0), (.15 * pickets, .38, .03)).box((0, .8, 0), (.15 * pickets, .88, .03))
    for i in range(pickets):
        x = .15 * i
        mesh.add([(x, 0, .03), (x + .09, 0, .03), (x + .09, 1, .03), (x + .045, 1.1, .03), (x, 1, .03), (x, 0, .05), (x + .09, 0, .05), (x + .09, 1, .05), (x + .045, 1.1, .05), (x, 1, .05)],
                 [(4, 3, 2, 1, 0), (5, 6, 7, 8, 9), *((i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i) for i in range(5))])
    return mesh


def rods():
    mesh = Mesh()
    for i in range(5):
        mesh.tube([(i * .5, 0, 0), (i * .5 + .8, 4, .6 * i)], .04, 6)
    return mesh


def slanted_rod():
    return Mesh().tube([(0, 0, 0), (3, 5, 2)], .03, 5)


def tripod():
    mesh = Mesh().box((-.1, 1.4, -.1), (.1, 1.6, .1))
    for x, z in circle(3, .6):
        mesh.tube([(0, 1.4, 0), (x, 0, z)], .02, 8)
    return mesh


def truss():
    mesh = Mesh()
    for z in (0, 2):
        mesh.tube([(0, 0, z), (20, 0, z)], .1, 6).tube([(2, 2.5, z), (18, 2.5, z)], .1, 6)
        for i in range(10):
            mesh.tube([(2 * i, 0, z), (2 * i + (2 if i % 2 == 0 else 0), 2.5, z)] if i % 2 == 0 else [(2 * i, 2.5, z), (2 * i + 2, 0, z)], .06, 5)
    for i in range(11):
        mesh.tube([(2 * i, 0, 0), (2 * i, 0, 2)], .06, 5)
    return mesh


def ring():
    path = [(3 * math.cos(t), 0, 3 * math.sin(t)) for t in (2 * math.pi * i / 40 for i in range(40))]
    return Mesh().tube(path, .8, 16, True)


def knot():
    path = [((2 + math.cos(3 * t)) * math.cos(2 * t), math.sin(3 * t), (2 + math.cos(3 * t)) * math.sin(2 * t)) for t in (2 * math.pi * i / 120 for i in range(120))]
    return Mesh().tube(path, .35, 12, True)


def chain():
    mesh = Mesh()
    for k in range(6):
        link = [(math.cos(t), math.sin(t) * .5) for t in (2 * math.pi * i / 20 for i in range(20))]
        mesh.tube([(x + 1.5 * k, y, 0) if k % 2 == 0 else (x + 1.5 * k, 0, y) for x, y in link], .12, 8, True)
    return mesh


def sphere(n=16):
    return Mesh().lathe([(math.sin(math.pi * (i + .02) / (n + .04)), -math.cos(math.pi * (i + .02) / (n + .04))) for i in range(n + 1)], 2 * n)


def capsule():
    half = [math.pi / 24 * i for i in range(13)]
    return Mesh().lathe([(.5 * math.sin(a) + .001, -1 - .5 * math.cos(a)) for a in half] + [(.5 * math.cos(a) + .001, 1 + .5 * math.sin(a)) for a in half], 40)


def cylinder():
    return Mesh().lathe([(1, 0), (1, 3)], 64)


def cone():
    return Mesh().lathe([(1, 0), (.001, 2)], 40)


def bowl():
    arc = [math.pi / 2 * i / 12 for i in range(13)]
    return Mesh().lathe([(math.sin(a) + .01, -math.cos(a)) for a in arc], 40, False)


def vase():
    heights = [i / 20 for i in range(21)]
    outer = [(.3 + .15 * math.sin(5 * y), 1.2 * y) for y in heights]
    return Mesh().lathe(outer + [(r - .03, y) for r, y in reversed(outer[1:])], 36)


def gear():
    outline = [(r * math.sin(a), r * math.cos(a)) for i in range(24) for r, a in ((1, math.pi / 12 * i - .06), (1.15, math.pi / 12 * i - .03), (1.15, math.pi / 12 * i + .03), (1, math.pi / 12 * i + .06))]
    inner = [(.3 * math.sin(2 * math.pi * i / 96), .3 * math.cos(2 * math.pi * i / 96)) for i in range(96)]
    loops = [[(x, y, z) for x, z in loop] for loop, y in ((outline, 0), (outline, .3), (inner, .3), (inner, 0))]
    return Mesh().rings(loops, True)


def wheel():
    mesh = Mesh().tube([(math.cos(t), math.sin(t), 0) for t in (2 * math.pi * i / 48 for i in range(48))], .08, 10, True).lathe([(.1, -.1), (.1, .1)], 16)
    for i in range(12):
        t = 2 * math.pi * i / 12
        mesh.tube([(0, 0, 0), (.97 * math.cos(t), .97 * math.sin(t), 0)], .015, 5)
    return mesh


def plate_with_holes():
    mesh, edge, n = Mesh(), 1.0, 16
    for i in range(5):
        for j in range(5):
            square = []
            for k in range(n):
                a = 2 * math.pi * (k + .5) / n
                s = edge / 2 / max(abs(math.sin(a)), abs(math.cos(a)))
                square.append((i + s * math.sin(a), j + s * math.cos(a)))
            hole = [(i + .3 * math.sin(2 * math.pi * (k + .5) / n), j + .3 * math.cos(2 * math.pi * (k + .5) / n)) for k in range(n)]
            loops = [[(x, y, z) for x, z in loop] for loop, y in ((square, 0), (square, .1), (hole, .1), (hole, 0))]
            mesh.rings(loops, True)
    return mesh


def ground_with_boxes():
    mesh = Mesh().add([(0, 0, 0), (40, 0, 0), (40, 0, 40), (0, 0, 40)], [(0, 3, 2, 1)])
    for x, z, h in ((5, 6, 4), (20, 25, 9), (30, 8, 2)):
        mesh.box((x, 0, z), (x + 6, h, z + 5))
    return mesh


def terrain():
    return Mesh().grid(lambda x, z: 3 * math.sin(x / 5) * math.cos(z / 7) + .4 * math.sin(x * 1.3 + z), 40, 40)


def rubble():
    mesh, rng = Mesh(), random.Random(8)
    for _ in range(60):
        x, z, s = rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(.1, .6)
        part = Mesh().box((-s, -s, -s), (s, s * rng.uniform(.2, 1), s)).turned(rng.uniform(0, 90))
        mesh.add([(a + x, b + rng.uniform(0, .01) + max(0, 1.5 - math.hypot(x, z) / 2), c + z) for a, b, c in part.points], part.faces)
    return mesh


def tree():
    mesh, rng = Mesh(), random.Random(4)
    mesh.tube([(0, 0, 0), (.1, 1.5, 0), (0, 3, .1)], .18, 8)
    for i in range(14):
        a, y = 2.4 * i, 1.3 + .12 * i
        tip = (1.1 * math.cos(a), y + .6, 1.1 * math.sin(a))
        mesh.tube([(0, y, 0), tip], .05, 5)
        for _ in range(25):
            c = [t + rng.uniform(-.35, .35) for t in tip]
            u, v = [rng.uniform(-.09, .09) for _ in range(3)], [rng.uniform(-.09, .09) for _ in range(3)]
            mesh.add([tuple(x + s * p + t * q for x, p, q in zip(c, u, v)) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))], [(0, 1, 2, 3)])
    return mesh


def letter():
    return Mesh().prism([(0, 0), (0, 5), (.8, 5), (.8, 3), (2.4, 3), (2.4, 2.2), (.8, 2.2), (.8, .8), (3, .8), (3, 0)], 0, .7)


def pipes():
    mesh, rng = Mesh(), random.Random(12)
    for i in range(6):
        at, path = [rng.uniform(0, 4), rng.uniform(0, 3), 0.0], []
        for k in range(6):
            path.append(tuple(at))
            at[k % 3] += rng.choice([-1, 1]) * rng.uniform(1, 3)
        mesh.tube(path, .15, 8)
    return mesh


def window_wall():
    mesh = Mesh()
    for i in range(9):
        mesh.box((2 * i, 0, 0), (2 * i + .5, 12, .3))
    for j in range(7):
        mesh.box((0, 2 * j, 0), (16.5, 2 * j + .5, .3))
    return mesh


def clamp():
    mesh = Mesh().prism([(0, 0), (0, 6), (4, 6), (4, 5), (1, 5), (1, 1), (4, 1), (4, 0)], 0, 1)
    return mesh.tube([(3.5, .5, 4.5), (3.5, .5, 2.2)], .2, 24).lathe([(.4, 0), (.4, .1)], 24)


def animal():
    mesh = Mesh().tube([(-1.2, 1, 0), (-.8, 1.1, 0), (0, 1.05, 0), (.8, 1.1, 0), (1.2, 1.2, 0)], .35, 16)
    for x in (-.8, .8):
        for z in (-.2, .2):
            mesh.tube([(x, 1, z), (x + .05, .5, z), (x, 0, z)], .1, 10)
    return mesh.tube([(1.1, 1.2, 0), (1.5, 1.8, 0), (1.9, 1.75, 0)], .18, 12).tube([(-1.2, 1.1, 0), (-1.7, .7, 0)], .05, 8)


def lamp():
    return Mesh().lathe([(.3, 0), (.3, .04), (.03, .08), (.03, 2)], 24).lathe([(.4, 1.8), (.25, 2.2)], 32, False)


KINDS = [tetrahedron, cube, roof, tent, crossed_sheets, l_shape, u_shape, house, houses, tower, stair, open_stair, spiral_stair, chair, table, round_table,
         shelf, fence, rods, slanted_rod, tripod, truss, ring, knot, chain, sphere, capsule, cylinder, cone, bowl, vase, gear, wheel, plate_with_holes,
         ground_with_boxes, terrain, rubble, tree, letter, pipes, window_wall, clamp, animal, lamp]
SCENES = {kind.__name__: kind for kind in KINDS} | {"turned_cube": lambda: cube(27), "long_fence": lambda: fence(60)}


def main():
    folder, names = Path(sys.argv[1]), sys.argv[2:]
    folder.mkdir(parents=True, exist_ok=True)
    for name, scene in SCENES.items():
        if not names or name in names:
            scene().write(folder / f"{name}.obj")


if __name__ == "__main__":
    main()
