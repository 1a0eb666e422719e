#!/usr/bin/env python3
"""Small sample scenes for the guides, as OBJ with materials.
    samples/scenes.py FOLDER [house|truck|figure|engine|city|office]...       all of them by default
house:   12 m wide, with rooms, furniture, an open door, windows of glass; y up
truck:   8 m long, of separate parts; y up
figure:  an animal on two legs, of overlapping parts; y up
engine:  two cylinders with fins, of separate parts; y up
city:    24 blocks of houses, towers and trees, in map coordinates; z up
office:  a block with a wing, at an angle of 30 degrees to the axes; y up
The same bytes on every machine."""
import math
import random
import sys
from pathlib import Path

MATERIALS = {"wall": (.85, .80, .70), "roof": (.62, .28, .20), "wood": (.50, .36, .22), "floor": (.55, .55, .55), "glass": (.6, .8, .9),
             "paint": (.15, .35, .60), "tyre": (.10, .10, .10), "metal": (.60, .62, .65), "skin": (.45, .60, .35), "horn": (.9, .85, .7),
             "tower": (.70, .72, .78), "leaf": (.25, .50, .22), "street": (.40, .40, .42)}


class Scene:
    """Faces of a scene, and the material of each."""

    def __init__(self):
        self.points, self.faces = [], []

    def add(self, points, faces, material):
        base = len(self.points) + 1
        self.points += points
        self.faces += [(material, [base + i for i in face]) for face in faces]

    def box(self, low, high, material):
        points = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
        self.add(points, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)], material)

    def tube(self, ends, radii, material, sides=16, caps=4):
        """A round bar from one end to the other; caps > 0: with round ends of so many rings."""
        (a, b), axis = ends, [q - p for p, q in zip(*ends)]
        length = math.dist(a, b)
        axis = [c / length for c in axis]
        helper = (0, 1, 0) if abs(axis[1]) < .9 else (1, 0, 0)
        u = unit(cross(helper, axis))
        v = cross(axis, u)
        rings = [(-radii[0] * math.cos(t), a, radii[0] * math.sin(t)) for t in angles(caps)] + [(0, a, radii[0]), (0, b, radii[1])]
        rings += [(radii[1] * math.cos(t), b, radii[1] * math.sin(t)) for t in reversed(angles(caps))]
        points = [ring(centre, axis, along, u, v, r, i * 2 * math.pi / sides) for along, centre, r in rings for i in range(sides)]
        n = len(rings)
        quads = [(r * sides + i, r * sides + (i + 1) % sides, (r + 1) * sides + (i + 1) % sides, (r + 1) * sides + i)
                 for r in range(n - 1) for i in range(sides)]
        self.add(points, quads + [tuple(reversed(range(sides))), tuple(range((n - 1) * sides, n * sides))], material)

    def gable(self, low, high, height, material, up=1):
        """A roof over a rectangle, ridge along x; up: the axis that points up."""
        across = 3 - up
        middle = (low[across] + high[across]) / 2
        place = lambda x, h, c: (x, h, c) if up == 1 else (x, c, h)
        points = [place(x, h, c) for x in (low[0], high[0])
                  for h, c in ((low[up], low[across]), (low[up], high[across]), (low[up] + height, middle))]
        faces = [(0, 1, 2), (3, 5, 4), (0, 2, 5, 3), (1, 4, 5, 2), (0, 3, 4, 1)]
        self.add(points, faces if up == 1 else [face[::-1] for face in faces], material)

    def wall(self, start, end, height, thick, openings, base=0.0):
        """Along x or z; openings: (from, to, sill, top, glass) along the wall."""
        along = 0 if start[0] != end[0] else 1
        place = lambda s, lo, e, hi, w, m: self.box(
            (start[0] + s, base + lo, start[1] - w) if along == 0 else (start[0] - w, base + lo, start[1] + s),
            (start[0] + e, base + hi, start[1] + w) if along == 0 else (start[0] + w, base + hi, start[1] + e), m)
        at = 0.0
        for left, right, sill, top, glass in sorted(openings):
            place(at, 0, left, height, thick / 2, "wall")
            if sill > 0:
                place(left, 0, right, sill, thick / 2, "wall")
            place(left, top, right, height, thick / 2, "wall")
            if glass:
                place(left, sill, right, top, .01, "glass")
            at = right
        place(at, 0, end[along] - start[along], height, thick / 2, "wall")

    def write(self, folder, name):
        used = sorted({material for material, _ in self.faces})
        with open(folder / f"{name}.mtl", "w", encoding="ascii") as out:
            for m in used:
                out.write("newmtl %s\nKd %g %g %g\n%s" % (m, *MATERIALS[m], "d 0.3\n" if m == "glass" else ""))
        with open(folder / f"{name}.obj", "w", encoding="ascii") as out:
            out.write(f"mtllib {name}.mtl\n")
            out.writelines("v %.4f %.4f %.4f\n" % p for p in self.points)
            for m in used:
                out.write(f"usemtl {m}\n")
                out.writelines("f " + " ".join(map(str, face)) + "\n" for material, face in self.faces if material == m)
        print(f"{folder / name}.obj: {sum(len(face) - 2 for _, face in self.faces)} triangles")


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    return [c / math.hypot(*a) for c in a]


def angles(count):
    return [math.pi / 2 * (k + .3) / (count + .3) for k in range(count)]


def ring(centre, axis, along, u, v, r, t):
    return tuple(centre[k] + axis[k] * along + r * (math.cos(t) * u[k] + math.sin(t) * v[k]) for k in range(3))


def house(s):
    window = lambda x: (x, x + 1.4, .9, 2.2, True)
    s.box((0, -.3, 0), (12, 0, 8), "floor")
    for level in (0, 2.9):
        s.wall((.15, .15), (11.85, .15), 2.7, .3, [window(1.5), window(8.5), (5.2, 6.4, 0 if level == 0 else .9, 2.2, level > 0)], level)
        s.wall((.15, 7.85), (11.85, 7.85), 2.7, .3, [window(1.5), window(5), window(8.5)], level)
        s.wall((.15, .15), (.15, 7.85), 2.7, .3, [window(3)], level)
        s.wall((11.85, .15), (11.85, 7.85), 2.7, .3, [window(1), window(5)], level)
        s.wall((4, .3), (4, 7.7), 2.7, .12, [(2, 2.9, 0, 2.1, False)], level)
        s.wall((8, .3), (8, 7.7), 2.7, .12, [(4, 4.9, 0, 2.1, False)], level)
        s.box((0, level + 2.7, 0), (12, level + 2.9, 8), "floor")
        for x in (1, 5.5, 9):
            s.box((x, level + .7, 5.5), (x + 1.6, level + .75, 6.4), "wood")
            for dx, dz in ((.05, .05), (1.5, .05), (.05, .8), (1.5, .8)):
                s.box((x + dx, level, 5.5 + dz), (x + dx + .05, level + .7, 5.55 + dz), "wood")
    s.gable((-.4, 5.8, -.4), (12.4, 5.8, 8.4), 2.6, "roof")
    s.box((9, 6.5, 2.2), (9.7, 8.8, 2.9), "roof")


def office(s):
    """A block with a wing and pilasters, at an angle of 30 degrees to the axes."""
    s.box((0, 0, 0), (20, 10, 12), "wall")
    s.box((0, 0, 0), (8, 8, 24), "wall")
    for i in range(10):
        s.box((2 * i + .6, 2, 11.9), (2 * i + 1.4, 8, 12.5), "tower")
    c, n = math.cos(math.pi / 6), math.sin(math.pi / 6)
    s.points = [(c * x + n * z, y, c * z - n * x) for x, y, z in s.points]


def truck(s):
    s.box((0, .75, -.45), (7.6, 1.0, .45), "metal")
    s.box((5.7, 1.0, -1.1), (7.8, 1.9, 1.1), "paint")
    s.box((5.7, 1.9, -1.1), (5.8, 2.9, 1.1), "paint")
    s.box((5.7, 2.9, -1.1), (7.3, 3.0, 1.1), "paint")
    for z in (-1.1, 1.0):
        s.box((7.2, 1.9, z), (7.3, 2.9, z + .1), "paint")
        s.box((6.4, 1.9, z), (6.5, 2.9, z + .1), "paint")
    s.box((6.1, 1.9, -.8), (6.5, 2.4, .8), "wood")
    s.box((0, 1.1, -1.2), (5.4, 1.2, 1.2), "metal")
    for z in (-1.2, 1.15):
        s.box((0, 1.2, z), (5.4, 1.75, z + .05), "paint")
    for x in (0, 5.35):
        s.box((x, 1.2, -1.2), (x + .05, 1.75, 1.2), "paint")
    for k in range(4):
        s.tube(((.5 + 1.2 * k, 1.55, -.9), (.5 + 1.2 * k, 1.55, .9)), (.35, .35), "wood", 20, 0)
    for x in (1.2, 2.4, 6.6):
        s.tube(((x, .5, -1.0), (x, .5, 1.0)), (.12, .12), "metal", 12, 0)
        for z in (-1.15, .75):
            s.tube(((x, .5, z), (x, .5, z + .4)), (.5, .5), "tyre", 24, 0)
    for z in (-1.35, 1.25):
        s.box((7.2, 2.1, z), (7.3, 2.6, z + .1), "metal")
    s.tube(((5.55, 1.0, .8), (5.55, 3.4, .8)), (.07, .07), "metal", 10, 0)


def figure(s):
    body = lambda a, b, r, q, m="skin": s.tube((a, b), (r, q), m, 24, 6)
    body((0, 1.0, 0), (0, 1.45, .05), .27, .22)
    body((0, 1.5, .05), (0, 1.85, .15), .12, .10)
    body((0, 1.95, .15), (0, 1.92, .42), .18, .11)
    for side in (-1, 1):
        body((.14 * side, .95, 0), (.20 * side, .50, .10), .15, .10)
        body((.20 * side, .50, .10), (.20 * side, .10, -.02), .09, .06)
        body((.20 * side, .07, -.04), (.22 * side, .05, .22), .07, .05)
        body((.24 * side, 1.45, .05), (.62 * side, 1.30, .10), .09, .065)
        body((.62 * side, 1.30, .10), (.85 * side, 1.55, .30), .06, .05)
        for k in range(4):
            body((.86 * side, 1.57, .31), ((.86 + .05 * (k - 1.5)) * side, 1.76, .36 + .03 * abs(k - 1.5)), .028, .018)
        body((.08 * side, 2.10, .12), (.16 * side, 2.32, .05), .04, .01, "horn")
    bend = [(0, .95, -.15), (0, .75, -.45), (0, .62, -.80), (.08, .68, -1.10), (.16, .82, -1.28)]
    for k in range(4):
        body(bend[k], bend[k + 1], .15 - .03 * k, .12 - .03 * k)


def engine(s):
    s.box((-.6, 0, -.8), (.6, 1.2, .8), "metal")
    s.box((-.75, -.3, -1), (.75, 0, 1), "tower")
    for k in range(8):
        s.tube(((-.68 + .194 * k, -.02, .93), (-.68 + .194 * k, .06, .93)), (.05, .05), "tyre", 6, 0)
    for side in (-1, 1):
        along = lambda x, y=.6, z=0: (side * x, y, z)
        s.tube((along(.55), along(2.1)), (.42, .42), "metal", 32, 0)
        for k in range(11):
            s.tube((along(.75 + .115 * k), along(.79 + .115 * k)), (.68, .68), "floor", 40, 0)
        s.box((min(side * 2, side * 2.5), -.05, -.65), (max(side * 2, side * 2.5), 1.25, .65), "paint")
        for y, z in ((.1, -.5), (.1, .5), (1.1, -.5), (1.1, .5)):
            s.tube((along(2.45, y, z), along(2.6, y, z)), (.09, .09), "metal", 6, 0)
        s.tube((along(2.25, 1.2), along(2.25, 1.75)), (.13, .13), "horn", 16, 0)
        s.tube((along(2.25, .0, .2), along(2.25, -.45, .2)), (.16, .2), "roof", 16, 0)
        s.tube((along(2.25, 1.65), along(.1, 1.65)), (.1, .1), "roof", 16, 2)
    s.tube(((0, .6, .8), (0, .6, 1.5)), (.16, .16), "floor", 24, 0)
    s.tube(((0, .6, 1.2), (0, .6, 1.35)), (.75, .75), "tower", 48, 0)
    s.tube(((0, 1.2, 0), (0, 1.95, 0)), (.2, .26), "leaf", 24, 3)


def city(s):
    rand = random.Random(7)
    x0, y0 = 84900.0, 447600.0
    s.box((x0 - 20, y0 - 20, -1), (x0 + 6 * 90, y0 + 4 * 90, 0), "street")
    for bx in range(6):
        for by in range(4):
            x, y = x0 + bx * 90, y0 + by * 90
            if rand.random() < .25:
                tower(s, rand, x, y)
            else:
                block(s, rand, x, y)


def block(s, rand, x, y):
    for row in (0, 1):
        for k in range(7):
            height = rand.uniform(5, 11)
            low, high = (x + k * 9.5, y + row * 40, 0), (x + k * 9.5 + 9, y + row * 40 + 11, height)
            s.box(low, high, "wall")
            s.gable((low[0], low[1], height), (high[0], high[1], height), rand.uniform(2, 4.5), "roof", 2)
            s.box((low[0] + 1, low[1] + 5, height), (low[0] + 1.8, low[1] + 5.8, height + 5), "roof")
    for _ in range(14):
        tx, ty, height = x + rand.uniform(2, 64), y + rand.uniform(15, 36), rand.uniform(4, 9)
        s.tube(((tx, ty, 0), (tx, ty, height * .5)), (.25, .2), "wood", 8, 0)
        s.tube(((tx, ty, height * .6), (tx, ty, height)), (1.8, .8), "leaf", 10, 2)


def tower(s, rand, x, y):
    height = rand.uniform(35, 90)
    s.box((x, y, 0), (x + 62, y + 50, 8), "wall")
    s.box((x + 12, y + 10, 8), (x + 40, y + 36, height), "tower")
    for k in range(int(height / 4) - 3):
        s.box((x + 11.6, y + 9.6, 10 + 4 * k), (x + 40.4, y + 36.4, 11 + 4 * k), "metal")
    for k in range(5):
        s.tube(((x + 15 + 5 * k, y + 22, height), (x + 15 + 5 * k, y + 22, height + rand.uniform(2, 9))), (.6, .3), "metal", 8, 0)


def main():
    scenes = {"house": house, "truck": truck, "figure": figure, "engine": engine, "city": city, "office": office}
    names = sys.argv[2:] or list(scenes)
    if {"-h", "--help"} & set(sys.argv[1:]):
        return print(__doc__)
    if len(sys.argv) < 2 or sys.argv[1].startswith("-") or not set(names) <= set(scenes):
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        scene = Scene()
        scenes[name](scene)
        scene.write(folder, name)


if __name__ == "__main__":
    main()
