#!/usr/bin/env python3
"""How many limbs of a model stay apart in its cages.
    cage_limbs.py SHAPE.obj CAGE.obj...      SHAPE: a closed mesh around the model, e.g.
    bpvox MODEL --resolution 200 | bpmesh --faces 20000 --enclose closing -o SHAPE.obj
    cage_limbs.py --test                     tests the measure on bars
Everything is measured on cubes, 160 along the longest side of the model, as lib/quads/limbs.h defines it, with no code in common.
The root of a connected part of the model is the cube that lies deepest in it. The cubes whose way from the roots is longer than t fall into
parts. A limb is a part that, at some t, before it meets the part of a farther tip, has a section that is narrower than the part is long from its
tip to t, and narrower than t. The part is at least 3 % of the model's diagonal long there. Its length is the way from its tip to where it meets another limb. A limb is apart in a cage if,
in the cage, the part within half its length of its tip holds no other tip.
Holes are counted on the meshes themselves: a ring has one.
Needs numpy. Prints the number of limbs, those that are apart, holes, and the tips of those that are not, in the coordinates of the mesh."""
import heapq
import math
import sys

import numpy as np

CUBES = 160
LEAST = 0.03  # of the diagonal: the least length of a limb
STEPS = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if (x, y, z) != (0, 0, 0)]


def read(path):
    """The vertices and triangles of an OBJ."""
    vertices, triangles = [], []
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(w) for w in words[1:4]])
            elif words[:1] == ["f"]:
                face = [int(w.split("/")[0]) - 1 for w in words[1:]]
                triangles += [(face[0], face[k], face[k + 1]) for k in range(1, len(face) - 1)]
    return np.array(vertices), np.array(triangles)


def inside(vertices, triangles, origin, cube, size):
    """The cubes whose middle lies inside: lines along z, which cross the surface an odd number of times below the middle."""
    points = (vertices - origin) / cube - 0.5 + np.array([1.3e-7, 2.9e-7, 0])  # no line meets an edge
    crossed = np.zeros(size + np.array([0, 0, 1]), dtype=np.int32)
    for t in triangles:
        a, b, c = points[t]
        low = np.maximum(np.ceil(np.minimum(np.minimum(a, b), c)[:2]), 0).astype(int)
        high = np.minimum(np.floor(np.maximum(np.maximum(a, b), c)[:2]), size[:2] - 1).astype(int)
        if (high < low).any():
            continue
        x, y = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1), indexing="ij")
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if area == 0:
            continue
        u = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
        v = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
        hit = (u >= 0) & (v >= 0) & (u + v <= 1)
        z = np.clip(np.ceil(a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2])), 0, size[2]).astype(int)
        np.add.at(crossed, (x[hit], y[hit], z[hit]), 1)
    return np.cumsum(crossed, axis=2)[:, :, :-1] % 2 == 1


def roots_of(solid, candidates=None):
    """The deepest cube of each connected part: it is left last if cubes beside empty ones are taken away, again and again. If there are candidates,
    the first of these in each part that has one."""
    if candidates is None:
        left, depth = np.pad(solid, 1), np.zeros(np.array(solid.shape) + 2, dtype=int)
        while left.any():
            depth += left
            core = left.copy()
            for axis in range(3):
                core &= np.roll(left, 1, axis) & np.roll(left, -1, axis)
            left = core
        cubes = np.argwhere(solid)
        candidates = [tuple(p) for p in cubes[np.argsort(-depth[1:-1, 1:-1, 1:-1][solid], kind="stable")].tolist()]
    roots, seen = [], np.zeros(solid.shape, dtype=bool)
    for root in candidates:
        if seen[root]:
            continue
        roots.append(root)
        seen[root], stack = True, [root]
        while stack:
            p = stack.pop()
            for q in neighbours(solid, p):
                if not seen[q]:
                    seen[q] = True
                    stack.append(q)
    return roots


def neighbours(solid, p):
    """The solid cubes around one."""
    for step in STEPS:
        q = (p[0] + step[0], p[1] + step[1], p[2] + step[2])
        if min(q) >= 0 and q[0] < solid.shape[0] and q[1] < solid.shape[1] and q[2] < solid.shape[2] and solid[q]:
            yield q


def ways(solid, roots):
    """The length of the shortest way from a root to each cube that they reach, in cubes."""
    way, queue = {root: 0.0 for root in roots}, [(0.0, root) for root in roots]
    while queue:
        far, p = heapq.heappop(queue)
        if far > way[p]:
            continue
        for q in neighbours(solid, p):
            length = far + math.sqrt(sum(a != b for a, b in zip(p, q)))
            if length < way.get(q, math.inf):
                way[q] = length
                heapq.heappush(queue, (length, q))
    return way


def width(section):
    """How far a section extends along one of the 13 directions between neighbours, at most."""
    points = np.array(section)
    return max((np.ptp(points @ np.array(s)) + sum(map(abs, s))) / math.sqrt(sum(map(abs, s))) for s in STEPS[:13])


class Parts:
    """Grows the parts of the cubes beyond t while t shrinks. Calls meet(tip of one, tip of the other, t) where two meet, and after each whole t
    grown(t, sections): the cubes between t and t + 1 by the tip of their part."""

    def __init__(self, way):
        self.way, self.up, self.tip = way, {}, {}
        self.order = sorted(way, key=lambda p: (-way[p], p))

    def find(self, p):
        while self.up[p] != p:
            self.up[p] = self.up[self.up[p]]
            p = self.up[p]
        return p

    def run(self, meet, end=0.0, grown=None):
        recent, whole = [], math.floor(self.way[self.order[0]]) if self.order else 0
        for p in self.order + [None]:
            if grown and (p is None or self.way[p] < whole):
                sections = {}
                for q in recent:
                    sections.setdefault(self.tip[self.find(q)], []).append(q)
                grown(whole, sections)
                recent, whole = [], 0 if p is None else math.floor(self.way[p])
            if p is None or self.way[p] < end:
                return
            recent.append(p)
            self.up[p] = self.tip[p] = p
            for step in STEPS:
                q = (p[0] + step[0], p[1] + step[1], p[2] + step[2])
                if q not in self.up:
                    continue
                a, b = self.find(p), self.find(q)
                if a == b:
                    continue
                far, near = sorted((a, b), key=lambda c: (-self.way[self.tip[c]], self.tip[c]))
                meet(self.tip[far], self.tip[near], self.way[p])
                self.up[near] = far


def limbs_of(solid, least):
    """The tips of the limbs, the length of each, and the roots."""
    roots = roots_of(solid)
    way = ways(solid, roots)
    tips, merges = set(), []

    def grown(t, sections):
        for tip, section in sections.items():
            if tip not in tips and way[tip] - t >= least and min(t, way[tip] - t) >= width(section):
                tips.add(tip)

    Parts(way).run(lambda far, near, t: merges.append((far, near, t)), grown=grown)
    length = {p: way[p] for p in tips}
    # In falling order of t. A part is named by its farthest tip, which may be no limb.
    limb = {p: [p] for p in tips}
    for far, near, t in merges:
        both = limb.get(far, []) + limb.get(near, [])
        if limb.get(far) and limb.get(near):
            for p in both:
                length[p] = min(length[p], way[p] - t)
        limb[far] = both
    return sorted(tips), length, roots


def apart(solid, tips, length, roots):
    """The tips of limbs that are apart in a solid around the model."""
    way = ways(solid, roots_of(solid, roots))
    result = []
    for tip in tips:
        parts = Parts(way)
        parts.run(lambda *_: None, way[tip] - length[tip] / 2)
        mine = parts.find(tip)
        if not any(o != tip and o in parts.up and parts.find(o) == mine for o in tips):
            result.append(tip)
    return result


def holes(triangles):
    """The number of holes through a closed mesh: by Euler's formula, summed over its parts."""
    up = {}

    def find(v):
        while up.setdefault(v, v) != v:
            up[v] = up[up[v]]
            v = up[v]
        return v

    edges = set()
    for t in triangles.tolist():
        for k in range(3):
            a, b = t[k], t[(k + 1) % 3]
            edges.add((min(a, b), max(a, b)))
            up[find(a)] = find(b)
    parts = len({find(v) for v in list(up)})
    return (2 * parts - (len(up) - len(edges) + len(triangles))) // 2


def bars(gap, count=5, web=0):
    """A beam with bars on it, `gap` cubes apart; the first `web` cubes of each gap are filled."""
    solid = np.zeros((count * (4 + gap) + 2, 44, 8), dtype=bool)
    solid[1:-1, 1:9, 1:7] = True
    for i in range(count):
        solid[1 + i * (4 + gap):5 + i * (4 + gap), 9:42, 2:6] = True
    solid[1:-1, 9:9 + web, 2:6] = True
    return solid


def test():
    solid = bars(3)
    tips, length, roots = limbs_of(solid, 10)
    assert len(tips) == 5 or len(tips) == 6, tips  # an end of the beam may be a sixth
    assert len(apart(solid, tips, length, roots)) == len(tips)
    assert len(apart(bars(3, web=8), tips, length, roots)) >= 5, "webs at the roots of limbs leave them apart"
    assert len(apart(bars(3, web=30), tips, length, roots)) <= 1, "webs up to the tips join limbs"
    x, y, z = np.meshgrid(*[np.arange(40) - 19.5] * 3)
    assert not limbs_of(x * x + y * y + z * z < 361, 2)[0], "a ball has no limbs"
    box = np.pad(np.ones((20, 30, 10), dtype=bool), 1)
    assert not limbs_of(box, 2)[0], "corners are no limbs"
    box[8:12, 30:, 4:8] = True
    assert not limbs_of(box, 2)[0], "a knob is wider than long"
    box = np.pad(box, ((0, 0), (0, 12), (0, 0)))
    box[8:12, 30:43, 4:8] = True
    assert len(limbs_of(box, 2)[0]) == 1, "a peg is a limb"
    two = np.concatenate([solid, np.zeros_like(solid), solid])
    assert len(limbs_of(two, 10)[0]) == 2 * len(tips), "each part has its limbs"
    cube = np.array([[x, y, z] for x in (1, 5) for y in (1, 5) for z in (1, 5)], dtype=float)
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    assert inside(cube, np.array(faces), np.zeros(3), 1.0, np.array([6, 6, 6])).sum() == 64
    assert holes(np.array(faces)) == 0
    ring = [(4 * i + k, 4 * ((i + 1) % 3) + k, 4 * ((i + 1) % 3) + (k + 1) % 4, 4 * i + (k + 1) % 4) for i in range(3) for k in range(4)]
    assert holes(np.array([t for a, b, c, d in ring for t in ((a, b, c), (a, c, d))])) == 1
    print("the measure counts the bars")


def main(shape, *cages):
    vertices, triangles = read(shape)
    low, high = vertices.min(0), vertices.max(0)
    cube = float((high - low).max()) / CUBES
    low, high = low - 8 * cube, high + 8 * cube  # cages reach beyond the model
    size = np.ceil((high - low) / cube).astype(int)
    model = inside(vertices, triangles, low, cube, size)
    tips, length, roots = limbs_of(model, LEAST * float(np.linalg.norm(high - low - 16 * cube)) / cube)
    print("%s: %d limbs, %d holes" % (shape, len(tips), holes(triangles)))
    for path in cages:
        points, faces = read(path)
        solid = inside(points, faces, low, cube, size) | model
        free = apart(solid, tips, length, roots)
        joined = ["%.4g,%.4g,%.4g" % tuple(low + (np.array(p) + 0.5) * cube) for p in tips if p not in free]
        print("%s: %d of %d limbs apart, %d holes, volume %.3f times the model's%s" % (
            path, len(free), len(tips), holes(faces), solid.sum() / model.sum(), "; joined: " + " ".join(joined) if joined else ""))


test() if sys.argv[1:] == ["--test"] else main(*sys.argv[1:])
