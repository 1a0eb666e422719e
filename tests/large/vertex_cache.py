#!/usr/bin/env python3
"""Tells how well the order of GLB files suits the caches of a GPU.
    tests/large/vertex_cache.py FILE.glb...
Prints for each file, over all its triangles: ACMR, vertices that are transformed for a triangle with a cache of the last 16 (0.5 is the least, 3 the most);
ATVR, times that a vertex is transformed (1 is the least); and the bytes of vertices fetched over the bytes that there are, with 64 lines of 64 bytes."""
import json
import struct
import sys
from collections import OrderedDict
from pathlib import Path

CACHE, LINES, LINE = 16, 64, 64
WORDS = {5121: "B", 5123: "H", 5125: "I"}


def primitives(path):
    """Yields the indices, and the number of vertices, of each primitive of a GLB that is not compressed."""
    data = Path(path).read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    gltf, binary = json.loads(data[20:20 + length]), data[28 + length:]
    for mesh in gltf["meshes"]:
        for primitive in mesh["primitives"]:
            accessor = gltf["accessors"][primitive["indices"]]
            view = gltf["bufferViews"][accessor["bufferView"]]
            word = WORDS[accessor["componentType"]]
            begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
            yield struct.unpack_from(f"<{accessor['count']}{word}", binary, begin), gltf["accessors"][primitive["attributes"]["POSITION"]]["count"]


def transformed(indices):
    """Returns how many vertices a cache of the last CACHE ones does not have."""
    cache, misses = [], 0
    for i in indices:
        if i not in cache:
            misses += 1
            cache = [*cache[-CACHE + 1:], i]
    return misses


def fetched(indices, stride=12):
    """Returns the bytes of positions that a cache of LINES lines reads."""
    cache, misses = OrderedDict(), 0
    for i in indices:
        for line in range(i * stride // LINE, (i * stride + stride - 1) // LINE + 1):
            if line in cache:
                cache.move_to_end(line)
                continue
            misses += 1
            cache[line] = None
            if len(cache) > LINES:
                cache.popitem(last=False)
    return misses * LINE


def main():
    for path in sys.argv[1:]:
        triangles = vertices = misses = read = 0
        for indices, count in primitives(path):
            triangles, vertices = triangles + len(indices) // 3, vertices + count
            misses, read = misses + transformed(indices), read + fetched(indices)
        print(f"{Path(path).name}: {triangles} triangles, {vertices} vertices: ACMR {misses / triangles:.3f}, ATVR {misses / vertices:.3f}, "
              f"fetched {read / (12 * vertices):.2f}")


if __name__ == "__main__":
    main()
