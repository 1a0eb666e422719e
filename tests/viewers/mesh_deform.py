"""Binds scenes to their cages with Blender's modifier Mesh Deform, and compares where a moved cage takes the vertices with bpdeform.
    blender -b --factory-startup --python-exit-code 1 -P mesh_deform.py -- SCENE.obj CAGE.obj [CAGE2.obj MOVED.obj]...
Prints a line of JSON for each moved cage: distances between both results over the diagonal of the scene. Fails if the modifier does
not bind."""
import json
import math
import sys

import bpy


def read(path):
    vertices, faces = [], []
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                corners = [int(word.split("/")[0]) for word in words[1:]]
                faces.append([i - 1 if i > 0 else len(vertices) + i for i in corners])
    return vertices, faces


def add(name, path):
    vertices, faces = read(path)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    return thing


def places(thing):
    return [v.co.copy() for v in thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices]


def main(scene_path, cage_path, *moved):
    scene, cage = add("scene", scene_path), add("cage", cage_path)
    modifier = scene.modifiers.new("bind", "MESH_DEFORM")
    modifier.object, modifier.precision = cage, 6
    bpy.context.view_layer.objects.active = scene
    bpy.ops.object.meshdeform_bind(modifier="bind")
    if not modifier.is_bound:
        sys.exit(f"Blender does not bind {scene_path} to {cage_path}")
    rest = [v.co.copy() for v in scene.data.vertices]
    diagonal = math.dist([min(p[i] for p in rest) for i in range(3)], [max(p[i] for p in rest) for i in range(3)])
    for posed, ours in zip(moved[::2], moved[1::2]):
        for vertex, place in zip(cage.data.vertices, read(posed)[0]):
            vertex.co = place
        cage.data.update()
        bpy.context.view_layer.update()
        pairs = list(zip(places(scene), read(ours)[0], rest))
        apart = [math.dist(theirs, own) / diagonal for theirs, own, _ in pairs]
        moves = [math.dist(own, place) / diagonal for _, own, place in pairs]
        print(json.dumps({"scene": scene_path.split("/")[-1], "cage": posed.split("/")[-1], "vertices": len(pairs),
                          "mean_move": round(sum(moves) / len(moves), 5), "mean_apart": round(sum(apart) / len(apart), 6),
                          "most_apart": round(max(apart), 6)}))


main(*sys.argv[sys.argv.index("--") + 1:])
