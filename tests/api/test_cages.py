#!/usr/bin/env python3
"""A cage whose quads are split at their middles still encloses the scene, with its margin, whichever diagonals are drawn (docs/bounding.md, 10)."""
import unittest

from scenes import SCENES, np

import bounding_proxies as bp


def faces_of(mesh):
    """The quads of a mesh, counter-clockwise, and the triangles that are left."""
    triangles = mesh.triangles.tolist()
    faces = []
    for a, b in mesh.quads:
        first = triangles[a]
        [apex] = set(triangles[b]) - set(first)
        k = next(k for k in range(3) if first[k] in triangles[b] and first[(k + 1) % 3] in triangles[b])
        faces.append([first[k], apex, first[(k + 1) % 3], first[(k + 2) % 3]])
    return faces + [t for i, t in enumerate(triangles) if i not in set(mesh.quads.ravel())]


def split_at_middles(vertices, faces):
    """New vertices at the middles of edges and faces, as programs subdivide without smoothing. Returns vertices and quads."""
    places, middles, quads = list(vertices), {}, []

    def middle(*edge):
        if frozenset(edge) not in middles:
            middles[frozenset(edge)] = len(places)
            places.append((vertices[edge[0]] + vertices[edge[1]]) / 2)
        return middles[frozenset(edge)]
    for face in faces:
        centre = len(places)
        places.append(np.mean(vertices[face], 0))
        quads += [[v, middle(v, face[(i + 1) % len(face)]), centre, middle(face[i - 1], v)] for i, v in enumerate(face)]
    return np.array(places), np.array(quads)


class Refined(unittest.TestCase):
    def test_a_cage_that_is_split_at_its_middles_keeps_scene_and_margin(self):
        for name, make in SCENES.items():
            scene = make()
            margin = 0.01 * np.linalg.norm(np.ptp(scene[0], 0))
            cage = bp.cage(*scene, 300, margin=margin)
            places, faces = cage.vertices, faces_of(cage)
            for times in (1, 2):
                places, faces = split_at_middles(places, faces)
                for first, second in (([0, 1, 2], [0, 2, 3]), ([0, 1, 3], [1, 2, 3])):
                    with self.subTest(scene=name, times=times, diagonal=second):
                        triangles = np.concatenate([faces[:, first], faces[:, second]])
                        self.assertTrue(bp.check((places, triangles), scene, margin=margin, distances=False))


if __name__ == "__main__":
    unittest.main()
