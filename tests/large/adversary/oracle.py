"""An exact judge of small proxies, as plain as possible: what `bpcheck` must answer, by definition.

It shares nothing with the suite. A mesh is a list of triangles, a triangle three points, a point three Fractions. All
answers are True or False; None means that this judge has no opinion (see `faces_outwards`).
Cost: every pair of triangles whose boxes meet is looked at, so it is meant for a few hundred triangles.
"""
import random
from collections import Counter, defaultdict
from fractions import Fraction
from math import isfinite


def exact(points):
    return tuple(tuple(Fraction(x) for x in p) for p in points)


def to_integers(*meshes):
    """All meshes multiplied by one power of two that makes every coordinate a whole number: integers are fast."""
    scale = max((x.denominator for mesh in meshes for t in mesh for p in t for x in p), default=1)
    for mesh in meshes:
        for t in mesh:
            for p in t:
                for x in p:
                    if scale % x.denominator:
                        scale *= x.denominator
    return [[tuple(tuple(int(x * scale) for x in p) for p in t) for t in mesh] for mesh in meshes]


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def sign(x):
    return (x > 0) - (x < 0)


def side(a, b, c, p):
    """The side of the plane through a, b, c on which p lies; 0 in the plane."""
    return sign(dot(cross(sub(b, a), sub(c, a)), sub(p, a)))


def flat(t):
    return cross(sub(t[1], t[0]), sub(t[2], t[0])) == (0, 0, 0)


def box(points):
    return tuple((min(p[i] for p in points), max(p[i] for p in points)) for i in range(3))


def boxes_meet(a, b):
    return all(a[i][0] <= b[i][1] and b[i][0] <= a[i][1] for i in range(3))


def edges(t):
    return ((t[0], t[1]), (t[1], t[2]), (t[2], t[0]))


def on_segment(p, a, b):
    """p lies on the closed segment a b."""
    if cross(sub(b, a), sub(p, a)) != (0, 0, 0):
        return False
    return all(min(a[i], b[i]) <= p[i] <= max(a[i], b[i]) for i in range(3))


def segments_meet(p, q, a, b):
    """Two closed segments in one plane have a point in common."""
    if any((on_segment(p, a, b), on_segment(q, a, b), on_segment(a, p, q), on_segment(b, p, q))):
        return True
    d = sub(q, p)
    n = cross(d, sub(b, a))
    if n == (0, 0, 0):
        return False
    s = [sign(dot(cross(d, sub(x, p)), n)) for x in (a, b)]
    r = [sign(dot(cross(sub(b, a), sub(x, a)), n)) for x in (p, q)]
    return s[0] * s[1] < 0 and r[0] * r[1] < 0


def in_triangle(p, t):
    """p, a point of the plane of t, lies in the closed triangle."""
    n = cross(sub(t[1], t[0]), sub(t[2], t[0]))
    return all(dot(cross(sub(b, a), sub(p, a)), n) >= 0 for a, b in edges(t))


def segment_meets(p, q, t):
    """The closed segment p q meets the closed triangle t, which has an area."""
    s, r = side(*t, p), side(*t, q)
    if s * r > 0:
        return False
    if s == 0 and r == 0:
        return in_triangle(p, t) or in_triangle(q, t) or any(segments_meet(p, q, a, b) for a, b in edges(t))
    o = [side(p, q, a, b) for a, b in edges(t)]
    return all(x >= 0 for x in o) or all(x <= 0 for x in o)


def triangles_meet(s, t):
    """Two closed triangles have a point in common. t has an area; s may be a segment or a point."""
    if any(segment_meets(a, b, t) for a, b in edges(s)):
        return True
    return not flat(s) and any(segment_meets(a, b, s) for a, b in edges(t))


def meet_beyond_what_they_share(s, t):
    """Two triangles of one mesh, each with an area, meet elsewhere than in the corner or edge that they share."""
    shared = [p for p in s if p in t]
    if len(shared) == 3:
        return True
    if not shared:
        return triangles_meet(s, t)
    if len(shared) == 1:
        opposite = lambda u: tuple(p for p in u if p != shared[0])
        return segment_meets(*opposite(s), t) or segment_meets(*opposite(t), s)
    a, b = shared
    p, q = next(x for x in s if x not in shared), next(x for x in t if x not in shared)
    if side(*s, q) != 0:
        return False
    edge = sub(b, a)
    return dot(cross(edge, sub(p, a)), cross(edge, sub(q, a))) > 0


def pairs(first, second):
    """Index pairs of triangles whose boxes meet, by a sweep along x. first is second: each pair once."""
    same = first is second
    boxes = [(box(t), 0, i) for i, t in enumerate(first)] + ([] if same else [(box(t), 1, i) for i, t in enumerate(second)])
    boxes.sort(key=lambda b: b[0][0][0])
    active = []
    for entry in boxes:
        active = [a for a in active if a[0][0][1] >= entry[0][0][0]]
        for other in active:
            if (same or other[1] != entry[1]) and boxes_meet(other[0], entry[0]):
                a, b = sorted((other, entry), key=lambda e: e[1:])
                yield a[2], b[2]
        active.append(entry)


def winding(p, mesh, seed=0):
    """The winding number of a closed mesh around p, which lies on none of its triangles. Exact: a ray that meets an edge is
    thrown again."""
    rng = random.Random(seed)
    while True:
        d = tuple(rng.randrange(-10**6, 10**6) for _ in range(3))
        total = 0
        for t in mesh:
            o = [dot(cross(sub(a, p), sub(b, p)), d) for a, b in edges(t)]
            if any(x == 0 for x in o):
                if all(x >= 0 for x in o) or all(x <= 0 for x in o):
                    break  # the line through p meets an edge or corner, or lies in the plane
                continue
            if not (all(x > 0 for x in o) or all(x < 0 for x in o)):
                continue
            n = cross(sub(t[1], t[0]), sub(t[2], t[0]))
            if sign(dot(n, sub(t[0], p))) == sign(dot(n, d)):  # ahead of p, not behind
                total += sign(dot(n, d))
        else:
            return total


def parts(mesh):
    """Triangles joined by edges, as lists of triangles."""
    parent = list(range(len(mesh)))

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    seen = {}
    for i, t in enumerate(mesh):
        for a, b in edges(t):
            key = (min(a, b), max(a, b))
            parent[root(i)] = root(seen.setdefault(key, i))
    groups = defaultdict(list)
    for i, t in enumerate(mesh):
        groups[root(i)].append(t)
    return list(groups.values())


def volume(mesh):
    """Six times the signed volume."""
    return sum(dot(t[0], cross(t[1], t[2])) for t in mesh)


def is_closed_manifold(mesh):
    """Closed, oriented, 2-manifold, by positions; no triangle without area, none twice."""
    if not mesh or any(flat(t) for t in mesh) or len({frozenset(t) for t in mesh}) < len(mesh):
        return False
    count = Counter(e for t in mesh for e in edges(t))
    if any(n != 1 or count.get((b, a), 0) != 1 for (a, b), n in count.items()):
        return False
    around = defaultdict(dict)
    for t in mesh:
        for i in range(3):
            around[t[i]][t[(i + 1) % 3]] = t[(i + 2) % 3]
    for ring in around.values():  # one fan around each corner
        first = at = next(iter(ring))
        steps = 0
        while steps < len(ring):
            at, steps = ring[at], steps + 1
            if at == first:
                break
        if steps < len(ring):
            return False
    return True


def is_embedded(mesh):
    return not any(meet_beyond_what_they_share(mesh[i], mesh[j]) for i, j in pairs(mesh, mesh))


def faces_outwards(mesh):
    """Parts that nothing surrounds have a positive volume. None: parts surround each other in ways that this cannot tell."""
    shells = parts(mesh)
    for i, shell in enumerate(shells):
        if volume(shell) > 0:
            continue
        others = [s for j, s in enumerate(shells) if j != i]
        if not any(winding(shell[0][0], s) != 0 for s in others):
            return False
    return True


def encloses(mesh, scene):
    """Every triangle of the scene lies strictly inside the mesh, which is closed."""
    for _ in pairs_that_touch(mesh, scene):
        return False
    return all(winding(t[0], mesh) >= 1 for t in scene)


def pairs_that_touch(mesh, scene):
    for i, j in pairs(scene, mesh):
        if triangles_meet(scene[i], mesh[j]):
            yield i, j


def lies_inside(mesh, scene):
    """The closed mesh lies strictly inside closed shells of the scene and meets none of its triangles. None: the scene is not
    closed, so that this cannot tell."""
    for _ in pairs_that_touch(mesh, scene):
        return False
    if any(winding(t[0], mesh) != 0 for t in scene):
        return False
    closed = [p for p in parts(scene) if is_closed_manifold(p)]
    inside = all(any(winding(part[0][0], shell) != 0 for shell in closed) for part in parts(mesh))
    return True if inside else (False if len(closed) == len(parts(scene)) and all(map(is_embedded, closed)) else None)


def cut(polygon, plane):
    """The parts of a convex polygon (or segment, or point) beyond a plane, and within it; each closed. plane: normal, offset."""
    n, c = plane
    d = [dot(n, p) - c for p in polygon]
    if all(x < 0 for x in d):
        return [], polygon
    if all(x >= 0 for x in d):
        return polygon, []
    beyond, within = [], []
    for i, p in enumerate(polygon):
        q, e = polygon[(i + 1) % len(polygon)], d[(i + 1) % len(polygon)]
        if d[i] >= 0:
            beyond.append(p)
        if d[i] <= 0:
            within.append(p)
        if d[i] * e < 0:
            t = Fraction(d[i]) / (d[i] - e)
            x = tuple(a + t * (b - a) for a, b in zip(p, q))
            beyond.append(x)
            within.append(x)
    return beyond, within


def is_convex(part):
    return all(side(*t, p) <= 0 for t in part for u in part for p in u)


def convex_parts_cover(mesh, scene):
    """Each point of the scene lies in the open inside of one of the parts, which are convex."""
    hulls = [[(cross(sub(t[1], t[0]), sub(t[2], t[0])), t[0]) for t in p] for p in parts(mesh)]
    hulls = [[(n, dot(n, p)) for n, p in planes] for planes in hulls]
    for t in scene:
        pieces = [list(t)]
        for planes in hulls:
            left = []
            for piece in pieces:
                for plane in planes:
                    beyond, piece = cut(piece, plane)
                    if beyond:
                        left.append(beyond)
                    if not piece:
                        break
            pieces = left
            if not pieces:
                break
        if pieces:
            return False
    return True


def judge(mesh, scene, question="around"):
    """What `bpcheck` must not contradict: True, False, or None. `mesh` and `scene`: lists of triangles of numbers; a coordinate
    that is not finite makes False."""
    if not all(isfinite(x) for m in (mesh, scene) for t in m for p in t for x in p):
        return False
    mesh, scene = to_integers([exact(t) for t in mesh], [exact(t) for t in scene])
    if question == "convex":
        return bool(mesh) and all(is_closed_manifold(p) and is_convex(p) for p in parts(mesh)) and convex_parts_cover(mesh, scene)
    if not is_closed_manifold(mesh) or not is_embedded(mesh):
        return False
    outwards = faces_outwards(mesh)
    if not outwards:
        return outwards
    return lies_inside(mesh, scene) if question == "inside" else encloses(mesh, scene)
