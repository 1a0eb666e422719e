#!/usr/bin/env python3
"""A scene of many parts falls on the floor as if it were of rubber: its cage is simulated, and bpdeform carries the scene.
    samples/softbody.py SCENE CAGE FOLDER [FRAMES]      OBJ, or a glTF scene; both y up, cage as OBJ; 48 frames, 24 a second
Writes FOLDER/cage.NN.obj and FOLDER/scene.NN.obj, and for an OBJ the pictures in softbody.png, which browsers play. A glTF gives one
file that moves. The tools are on PATH. The same frames on every machine of one kind.
The body is made of springs, by extended position-based dynamics: the edges of the cage, and soft ones through it. The volume is kept."""
import math
import random
import shutil
import struct
import subprocess
import sys
import zlib
from pathlib import Path

RATE, STEPS, GRAVITY, FRICTION, DAMPING = 24, 12, 9.81, .3, .002
HEIGHT = 2.4  # of every body while it falls: a model may be in any unit
EDGE, BRACE, VOLUME = 1.2e-2, .12, 1e-9  # compliances, for masses that sum to 1
BRACES = 10  # of each vertex


def read_cage(path):
    lines = path.read_text().splitlines()
    points = [[float(word) for word in line.split()[1:4]] for line in lines if line.startswith("v ")]
    faces = [[int(word.split("/")[0]) - 1 for word in line.split()[1:]] for line in lines if line.startswith("f ")]
    return lines, points, faces


def write_cage(path, lines, points):
    left = iter(points)
    path.write_text("".join(("v %.9g %.9g %.9g" % tuple(next(left)) if line.startswith("v ") else line) + "\n" for line in lines))


def springs(points, faces):
    """(i, j, length, compliance)"""
    pairs = {tuple(sorted(pair)): EDGE for face in faces for pair in zip(face, face[1:] + face[:1])}
    draw = random.Random(1)
    for i in range(len(points)):
        for j in draw.sample(range(len(points)), min(BRACES, len(points))):
            if i != j:
                pairs.setdefault(tuple(sorted((i, j))), BRACE)
    return [(i, j, math.dist(points[i], points[j]), soft) for (i, j), soft in sorted(pairs.items())]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def volume_of(points, triangles):
    return sum(p * q for a, b, c in triangles for p, q in zip(points[a], cross(points[b], points[c]))) / 6


def keep_volume(points, triangles, rest, weight, stiff):
    """Moves all points along the gradient of the volume."""
    gradient = [[0, 0, 0] for _ in points]
    for a, b, c in triangles:
        for i, part in ((a, cross(points[b], points[c])), (b, cross(points[c], points[a])), (c, cross(points[a], points[b]))):
            for k in range(3):
                gradient[i][k] += part[k] / 6
    size = weight * sum(g * g for row in gradient for g in row)
    push = (rest - volume_of(points, triangles)) / (size + stiff)
    for point, row in zip(points, gradient):
        for k in range(3):
            point[k] += weight * push * row[k]


def pull(points, bars, weight, per_square):
    for i, j, length, soft in bars:
        a, b = points[i], points[j]
        x, y, z = b[0] - a[0], b[1] - a[1], b[2] - a[2]
        now = math.sqrt(x * x + y * y + z * z) or 1e-12
        push = weight * (now - length) / ((2 * weight + soft * per_square) * now)
        a[0] += push * x; a[1] += push * y; a[2] += push * z
        b[0] -= push * x; b[1] -= push * y; b[2] -= push * z


def simulate(rest, faces, frames):
    """Yields the points of each frame. It falls tilted, from less than half its height."""
    unit = (max(p[1] for p in rest) - min(p[1] for p in rest)) / HEIGHT
    rest = [[c / unit for c in p] for p in rest]
    low, high = (min(p[1] for p in rest), max(p[1] for p in rest))
    tilt, lift = math.radians(8), .4 * (high - low)
    points = [[p[0] * math.cos(tilt) - p[1] * math.sin(tilt), p[0] * math.sin(tilt) + p[1] * math.cos(tilt), p[2]] for p in rest]
    drop = lift - min(p[1] for p in points)
    points = [[p[0], p[1] + drop, p[2]] for p in points]
    bars, triangles = springs(rest, faces), [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]
    volume = volume_of(rest, triangles)
    weight, step = float(len(points)), 1 / RATE / STEPS
    speeds = [[0.0, 0.0, 0.0] for _ in points]
    for _ in range(frames):
        yield [[unit * c for c in p] for p in points]
        for _ in range(STEPS):
            before = [p[:] for p in points]
            for p, v in zip(points, speeds):
                v[1] -= step * GRAVITY
                for k in range(3):
                    p[k] += step * v[k]
            pull(points, bars, weight, 1 / step ** 2)
            keep_volume(points, triangles, volume, weight, VOLUME / step ** 2)
            for p, old in zip(points, before):
                if p[1] < 0:
                    p[:] = [p[0] - FRICTION * (p[0] - old[0]), 0.0, p[2] - FRICTION * (p[2] - old[2])]
            speeds = [[(1 - DAMPING) * (a - b) / step for a, b in zip(p, old)] for p, old in zip(points, before)]


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def animated_png(pictures, out):
    """Pictures of one size, one after the other."""
    parts, number = [b"\x89PNG\r\n\x1a\n"], 0
    for at, picture in enumerate(pictures):
        data, place = picture.read_bytes(), 8
        while place < len(data):
            size, kind = struct.unpack(">I4s", data[place:place + 8])
            content, place = data[place + 8:place + 8 + size], place + 12 + size
            if kind == b"IHDR" and at == 0:
                parts += [chunk(kind, content), chunk(b"acTL", struct.pack(">II", len(pictures), 0))]
            if kind == b"IHDR":
                parts.append(chunk(b"fcTL", struct.pack(">I", number) + content[:8] + struct.pack(">IIHHBB", 0, 0, 1, RATE, 0, 0)))
                number += 1
            elif kind == b"IDAT" and at == 0:
                parts.append(chunk(kind, content))
            elif kind == b"IDAT":
                parts.append(chunk(b"fdAT", struct.pack(">I", number) + content))
                number += 1
    out.write_bytes(b"".join(parts) + chunk(b"IEND", b""))


def add_floor(path, reach, height):
    """The same floor in each picture, and two specks beyond it: so all pictures show the same place."""
    with path.open("a") as file:
        for x, z in ((-.8, -.8), (-.8, .8), (.8, .8), (.8, -.8)):
            print("v", x * reach, -.003 * height, z * reach, file=file)
        for side, y in ((-1, height), (1, 0)):
            for i in range(3):
                print("v", side * reach + i % 2 * 1e-4, y, side * reach + i // 2 * 1e-4, file=file)
        print("usemtl floor\nf -10 -9 -8 -7\nf -6 -5 -4\nf -3 -2 -1", file=file)


def main(scene, cage, folder, frames="48"):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    kind = Path(scene).suffix
    lines, points, faces = read_cage(Path(cage))
    subprocess.run(["bpdeform", "bind", scene, cage, "-o", folder / "scene.bpw", "--overwrite"], check=True)
    cages, top, reach = [], 0, 0
    for number, posed in enumerate(simulate(points, faces, int(frames))):
        cages.append(folder / f"cage.{number:03}.obj")
        write_cage(cages[-1], lines, posed)
        top, reach = max([top] + [p[1] for p in posed]), max([reach] + [abs(p[k]) for p in posed for k in (0, 2)])
    one_file = ["--animate", str(RATE)] if kind in (".glb", ".gltf") else []
    subprocess.run(["bpdeform", "apply", folder / "scene.bpw", *cages, *one_file, "-o", folder / f"scene{kind}", "--overwrite", "-q"],
                   check=True)
    if kind != ".obj":
        return print("softbody: pictures are made of OBJ scenes only" if not one_file else f"softbody: {folder}/scene{kind} moves")
    pictures = []
    for material in Path(scene).parent.glob("*.mtl"):
        shutil.copy(material, folder)
    for posed in sorted(folder.glob("scene.*.obj")):
        add_floor(posed, reach, top)
        pictures.append(posed.with_suffix(".png"))
        subprocess.run(["bpinfo", posed, "--image", pictures[-1], "--image-size", "360", "--zoom", "1.1", "--overwrite"], check=True,
                       stdout=subprocess.DEVNULL)
    animated_png(pictures, folder / "softbody.png")


if __name__ == "__main__":
    if {"-h", "--help"} & set(sys.argv[1:]):
        print(__doc__)
        sys.exit()
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (OSError, ValueError, subprocess.CalledProcessError) as fault:
        sys.exit(f"softbody: {fault}")
