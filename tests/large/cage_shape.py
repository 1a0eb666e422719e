#!/usr/bin/env python3
"""How regular cages are: the share of their triangles that are in quads, of vertices with four edges, and how far edges lie off the
principal directions of the shape and corners of quads off 90 degrees, on average.
    cage_shape.py SHAPE.obj CAGE.obj...      SHAPE: a smooth mesh of the model, e.g.
    bpvox MODEL --resolution 200 | bpclose --scale 3% | bpmesh --faces 8000 --enclose closing -o SHAPE.obj
Directions are those of the curvature tensors of edges (Cohen-Steiner and Morvan 2003), averaged over neighbours; an edge counts by its
length and by how much the two curvatures differ. By chance it lies 22.5 degrees off."""
import math
import sys

ROUNDS = 6  # of averaging


def read(path):
    vertices, faces = [], []
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append(tuple(map(float, words[1:4])))
            elif words[:1] == ["f"]:
                faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return vertices, faces


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    size = math.hypot(*a)
    return tuple(x / size for x in a) if size > 0 else (0, 0, 0)


def edges_of(faces):
    """Of each edge, its faces, and whether they run along it from the lower vertex."""
    edges = {}
    for i, face in enumerate(faces):
        for k, a in enumerate(face):
            b = face[(k + 1) % len(face)]
            edges.setdefault((min(a, b), max(a, b)), []).append((i, a < b))
    return edges


def tensors_of(vertices, faces):
    """Of each vertex: its normal and curvature tensor, as rows."""
    areas = [cross(sub(vertices[f[1]], vertices[f[0]]), sub(vertices[f[2]], vertices[f[0]])) for f in faces]
    normals, tensors, near = [(0, 0, 0)] * len(vertices), [[0] * 9 for _ in vertices], [[] for _ in vertices]
    for face, area in zip(faces, areas):
        for v in face:
            normals[v] = tuple(x + y for x, y in zip(normals[v], area))
    for (a, b), sides in edges_of(faces).items():
        e = sub(vertices[b], vertices[a])
        one, other = (unit(areas[i]) for i, _ in sorted(sides, key=lambda side: not side[1]))
        weight = math.atan2(dot(cross(one, other), unit(e)), dot(one, other)) / max(math.hypot(*e), 1e-300)
        for v, u in ((a, b), (b, a)):
            near[v].append(u)
            tensors[v] = [t + weight * e[i // 3] * e[i % 3] for i, t in enumerate(tensors[v])]
    for _ in range(ROUNDS):
        tensors = [[sum(row) / (1 + len(near[v])) for row in zip(tensors[v], *(tensors[u] for u in near[v]))]
                   for v in range(len(vertices))]
    return [unit(n) for n in normals], tensors


def direction_of(normal, tensor):
    """One of the two principal directions, and how much the curvatures differ, from 0 to 1."""
    a = unit(cross(normal, (1, 0, 0) if abs(normal[0]) < 0.8 else (0, 1, 0)))
    b = cross(normal, a)
    form = lambda x, y: sum(x[i] * tensor[3 * i + j] * y[j] for i in range(3) for j in range(3))
    half, mixed, mean = (form(a, a) - form(b, b)) / 2, form(a, b), abs(form(a, a) + form(b, b)) / 2
    turn, spread = math.atan2(mixed, half) / 2, math.hypot(half, mixed)
    return tuple(math.cos(turn) * x + math.sin(turn) * y for x, y in zip(a, b)), spread / max(spread + mean, 1e-300)


def main(shape, *cages):
    points, faces = read(shape)
    normals, tensors = tensors_of(points, faces)
    field = [direction_of(n, t) for n, t in zip(normals, tensors)]
    for path in cages:
        vertices, polygons = read(path)
        edges = edges_of(polygons)
        valence, off, weights, corners = [0] * len(vertices), 0, 0, []
        for a, b in edges:
            valence[a] += 1
            valence[b] += 1
            middle = tuple((x + y) / 2 for x, y in zip(vertices[a], vertices[b]))
            i = min(range(len(points)), key=lambda k: math.dist(points[k], middle))
            e, (way, share) = sub(vertices[b], vertices[a]), field[i]
            flat = unit(sub(e, tuple(dot(e, normals[i]) * x for x in normals[i])))
            angle = math.degrees(math.acos(min(1, abs(dot(flat, way)))))
            off += min(angle, 90 - angle) * share * math.hypot(*e)
            weights += share * math.hypot(*e)
        quads = [p for p in polygons if len(p) == 4]
        for q in quads:
            for k in range(4):
                sides = (unit(sub(vertices[q[(k + step) % 4]], vertices[q[k]])) for step in (1, 3))
                corners.append(abs(90 - math.degrees(math.acos(max(-1, min(1, dot(*sides)))))))
        print("%s: %d faces, %.0f %% of triangles in quads, %.0f %% of vertices have 4 edges, edges %.1f off, corners %.1f off" % (
            path, len(polygons), 200 * len(quads) / (2 * len(quads) + len(polygons) - len(quads)),
            100 * valence.count(4) / len(valence), off / weights, sum(corners) / max(len(corners), 1)))


main(*sys.argv[1:])
