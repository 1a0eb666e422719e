#!/usr/bin/env python3
"""Tries to make the suite say what is not true. Every answer is held against an exact judge that shares nothing with it (oracle.py).

usage: adversary.py mutants|scenes BIN_DIR [--first SEED] [--count N] [--jobs N] [--out FILE.jsonl] [--keep DIR]

mutants  makes a proxy of a random scene, damages proxy or scene in one of many ways, writes both in random formats, asks bpcheck.
scenes   runs random scenes through the tools with random options, reads the outputs back, asks bpcheck and the judge.

A line of JSON for each run; the last lines count the answers. Exit 1 if there is one of these:
  wrong holds  bpcheck says 0 and the judge says that it does not hold
  wrong NO     bpcheck says 1 and the judge says that it holds
  wrong made   a tool's own output does not hold (scenes)
  other        a crash, a hang, an exit code that the manuals do not name
The same seed makes the same run. --keep leaves the files of such runs in DIR/SEED.
"""
import argparse
import concurrent.futures
import json
import math
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections import Counter

import files
from oracle import judge

CUBE = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]
TETRA = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]


def box(lo, hi):
    corners = [(x, y, z) for z in (lo[2], hi[2]) for y in (lo[1], hi[1]) for x in (lo[0], hi[0])]
    return [tuple(corners[i] for i in t) for t in CUBE]


def tetra(at, size, inverted=False):
    corners = [at, (at[0] + size, at[1], at[2]), (at[0], at[1] + size, at[2]), (at[0], at[1], at[2] + size)]
    mesh = [tuple(corners[i] for i in t) for t in TETRA]
    return [(a, c, b) for a, b, c in mesh] if inverted else mesh


def point(rng, size=1.0):
    return tuple(rng.uniform(-size, size) for _ in range(3))


def random_scene(rng, question):
    """A few dozen triangles: boxes, tetrahedra, sheets, loose triangles, segments and points, some of them open or turned over.
    For proxies inside, what comes first is a solid that has room for one."""
    mesh = []
    for n in range(rng.choice([1, 1, 2, 3, 5])):
        first = question == "inside" and n == 0
        kind, at = rng.randrange(3 if first else 8), point(rng)
        size = tuple(rng.choice([1.0] if first else [0.002, 0.1, 0.4, 1.0]) * rng.uniform(0.5, 1) for _ in range(3))
        if kind <= 2:
            part = box(at, tuple(a + s for a, s in zip(at, size)))
        elif kind == 3:
            part = tetra(at, size[0])
        elif kind == 4:  # a sheet, bent
            grid = [[(at[0] + size[0] * i, at[1] + rng.uniform(0, 0.1), at[2] + size[2] * j) for j in range(4)] for i in range(4)]
            part = [t for i in range(3) for j in range(3) for t in ((grid[i][j], grid[i + 1][j], grid[i][j + 1]), (grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]))]
        elif kind == 5:
            part = [(at, point(rng), point(rng)) for _ in range(rng.randrange(1, 5))]
        elif kind == 6:  # a segment and a point, as triangles without area
            end = point(rng)
            part = [(at, end, at), (end, end, end)]
        else:
            part = box(at, (at[0] + size[0], at[1] + size[1], at[2] + size[0]))[2:]
        if rng.random() < 0.2:
            part = [(a, c, b) for a, b, c in part]
        mesh += part
    scale, shift = rng.choice([1.0, 1.0, 1e-3, 1e3]), rng.choice([(0, 0, 0), (0, 0, 0), (10.0, -3.0, 7.5), (654321.25, 5820000.5, 33.0), (1e6, 1e6, 1e6)])
    if rng.random() < 0.4:  # as drawn on a grid: exact contacts, planes along the axes
        mesh = [tuple(tuple(round(x * 8) / 8 for x in p) for p in t) for t in mesh]
    mesh = [tuple(tuple(x * scale + s for x, s in zip(p, shift)) for p in t) for t in mesh]
    return mesh


def span(mesh):
    points = [p for t in mesh for p in t]
    lo, hi = [min(p[i] for p in points) for i in range(3)], [max(p[i] for p in points) for i in range(3)]
    return lo, hi, math.dist(lo, hi)


def replace(mesh, old, new):
    return [tuple(new if p == old else p for p in t) for t in mesh]


def small(rng, diagonal):
    return diagonal * 10 ** rng.uniform(-17, 0)


def nudged(rng, p, diagonal):
    if rng.random() < 0.3:
        i = rng.randrange(3)
        return tuple(math.nextafter(x, rng.choice([-math.inf, math.inf])) if j == i else x for j, x in enumerate(p))
    step = small(rng, diagonal)
    return tuple(x + rng.uniform(-step, step) for x in p)


def inside_of(rng, t):
    w = [rng.random() for _ in range(3)]
    return tuple(sum(a * p[i] for a, p in zip(w, t)) / sum(w) for i in range(3))


def damage(rng, proxy, scene):
    """Returns a name, the damaged proxy, the damaged scene. Many of these leave a proxy that holds: the judge tells."""
    proxy, scene = list(proxy), list(scene)
    lo, hi, diagonal = span(scene + proxy)
    corner = rng.choice(rng.choice(proxy))
    i, j = rng.randrange(len(proxy)), rng.randrange(len(scene))
    away = tuple(rng.uniform(a, b) for a, b in zip(lo, hi))

    def move():
        return replace(proxy, corner, nudged(rng, corner, diagonal)), scene

    def onto_scene():
        return replace(proxy, corner, rng.choice(scene[j])), scene

    def onto_triangle():
        return replace(proxy, corner, inside_of(rng, scene[j])), scene

    def leave_out():
        return proxy[:i] + proxy[i + 1:], scene

    def twice():
        return proxy + [rng.choice([proxy[i], proxy[i][1:] + proxy[i][:1]])], scene

    def turn():
        return proxy[:i] + [(proxy[i][0], proxy[i][2], proxy[i][1])] + proxy[i + 1:], scene

    def turn_all():
        return [(a, c, b) for a, b, c in proxy], scene

    def collapse():
        return replace(proxy, proxy[i][0], proxy[i][1]), scene

    def crack():  # a corner on an edge, in one of its two triangles only
        a, b, c = proxy[i]
        m = tuple((x + y) / 2 for x, y in zip(a, b))
        return proxy[:i] + [(a, m, c), (m, b, c)] + proxy[i + 1:], scene

    def sheet():
        a, b, c = proxy[i]
        return proxy + [(a, b, away), (b, a, away)], scene

    def another_part():
        return proxy + tetra(away, max(small(rng, diagonal), 1e-12), rng.random() < 0.5), scene

    def hollow_around():
        at = rng.choice(scene[j])
        size = small(rng, diagonal)
        return proxy + tetra(tuple(x - size / 5 for x in at), size, True), scene

    def pinch():
        return replace(proxy, corner, rng.choice(rng.choice(proxy))), scene

    def shrink():
        s = rng.choice([0.5, 0.9, 0.99, 0.999])
        middle = [(a + b) / 2 for a, b in zip(lo, hi)]
        return [tuple(tuple(m + (x - m) * s for x, m in zip(p, middle)) for p in t) for t in proxy], scene

    def shift():
        d = tuple(rng.uniform(-1, 1) * small(rng, diagonal) for _ in range(3))
        return [tuple(tuple(x + y for x, y in zip(p, d)) for p in t) for t in proxy], scene

    def not_a_number():
        return replace(proxy, corner, (rng.choice([math.nan, math.inf, -math.inf]), corner[1], corner[2])), scene

    def scene_moves():
        old = rng.choice(scene[j])
        return proxy, replace(scene, old, nudged(rng, old, diagonal))

    def scene_touches():
        return proxy, replace(scene, rng.choice(scene[j]), rng.choice([corner, inside_of(rng, proxy[i])]))

    def spike():  # a triangle without area that may leave the proxy
        a = rng.choice(scene[j])
        b = tuple(x + small(rng, diagonal) * rng.choice([-1, 1]) for x in a)
        return proxy, scene + [rng.choice([(a, b, a), (a, b, b), (b, b, b), (a, b, tuple(2 * y - x for x, y in zip(a, b)))])]

    def far_triangle():
        a = tuple(x + rng.choice([-1, 1]) * diagonal * 10 ** rng.uniform(0, 6) for x in away)
        return proxy, scene + [(a, nudged(rng, a, diagonal), nudged(rng, a, diagonal))]

    def flip_edge():
        a, b, c = proxy[i]
        for k, t in enumerate(proxy):
            if k != i and a in t and b in t:
                d = next(p for p in t if p not in (a, b))
                rest = [u for n, u in enumerate(proxy) if n not in (i, k)]
                return rest + [(a, d, c), (d, b, c)], scene
        return proxy, scene

    def nothing():
        return proxy, scene

    ways = [move] * 6 + [onto_scene, onto_triangle, leave_out, twice, turn, turn_all, collapse, crack, sheet, another_part, hollow_around, pinch,
                         shrink, shift, shift, not_a_number, scene_moves, scene_moves, scene_touches, spike, spike, far_triangle, flip_edge, nothing]
    way = rng.choice(ways)
    return (way.__name__, *way())


class Tools:
    def __init__(self, folder, work):
        self.folder, self.work = folder, work

    def __call__(self, *command, seconds=120):
        tool, *rest = map(str, command)
        return subprocess.run([os.path.join(self.folder, tool), *rest, "-j", "1"], cwd=self.work, capture_output=True, text=True, timeout=seconds)


NAMED = {0, 1, 2, 3, 4, 5}


def wrong(code, truth):
    if code not in NAMED:
        return "other"
    return "wrong holds" if code == 0 and truth is False else "wrong NO" if code == 1 and truth is True else ""


def make_proxy(tool, rng, scene, question):
    """A proxy of the scene that answers the question, and what the scene's file says; or None where the tools refuse it, and why."""
    path, said = files.write(scene, rng.choice(["obj", "ply", "off"]), os.path.join(tool.work, "made"), rng)
    if question == "convex":
        done = tool("bplod", path, "--profile", "collision", "--resolution", rng.choice([12, 24]), "--hulls", rng.choice([1, 3, 8]), "--name", "n", "-q", "-o", "out")
        made = os.path.join(tool.work, "out", "n_unreal.glb")
        return (files.read_glb(made), said) if done.returncode == 0 else (None, done.stderr.strip()[-200:])
    fill = ["--fill", "inside"] if question == "inside" else []
    for command in (["bpvox", path, "--resolution", rng.choice([8, 16, 32]), *fill, "-o", "a.bpv"], ["bpclose", "a.bpv", "--scale", rng.choice(["0", "2%", "10%"]), "-o", "b.bpv"],
                    ["bpmesh", "b.bpv", "--faces", rng.choice([12, 30, 80]), *(["--enclose", "closing"] if question == "around" and rng.random() < 0.3 else []), "-o", "p.obj"]):
        done = tool(*command, "-q")
        if done.returncode != 0:
            return None, done.stderr.strip()[-200:]
    return files.read_obj(os.path.join(tool.work, "p.obj")), said


def as_numbers(mesh):
    return [tuple(tuple(float(x) for x in p) for p in t) for t in mesh]


def one_mutant(tool, rng):
    question = rng.choice(["around", "around", "around", "inside", "convex"])
    proxy, scene = make_proxy(tool, rng, random_scene(rng, question), question)
    row = {"question": question}
    if not proxy:
        return {**row, "refused": True, "said": scene}
    way, proxy, scene = damage(rng, as_numbers(proxy), as_numbers(scene))
    proxy_kind, scene_kind = rng.choice(["obj", "ply", "off", "glb", "stl"]), rng.choice(list(files.WRITERS))
    row.update(way=way, proxy=proxy_kind, scene=scene_kind)
    try:
        scene_path, scene = files.write(scene, scene_kind, os.path.join(tool.work, "scene"), rng)
        proxy_path, proxy = files.write(proxy, proxy_kind, os.path.join(tool.work, "proxy"), rng)
        truth = judge(proxy, scene, question)
    except (OverflowError, ValueError, subprocess.CalledProcessError):  # a NaN or infinity, which is no Fraction; or too far for float32
        truth = False
        if not os.path.exists(os.path.join(tool.work, f"proxy.{proxy_kind}")):
            return {**row, "way": way + " (not written)"}
        proxy_path = os.path.join(tool.work, f"proxy.{proxy_kind}")
    flags = {"around": [], "inside": ["--inside"], "convex": ["--convex"]}[question]
    ending = proxy_path.rsplit(".", 1)[1]
    if ending in files.DECORATIONS and proxy_kind != "draco" and rng.random() < 0.2:
        n = rng.randrange(len(files.DECORATIONS[ending]))
        files.DECORATIONS[ending][n](proxy_path, rng)
        done = tool("bpcheck", *flags, scene_path, proxy_path)
        bad = "wrong holds" if done.returncode == 0 else "" if done.returncode in (1, 3, 5) else "other"
        return {**row, "way": f"{ending} decorated {n}", "exit": done.returncode, "wrong": bad, "said": done.stderr.strip()[-200:]}
    done = tool("bpcheck", *flags, scene_path, proxy_path)
    return {**row, "truth": truth, "exit": done.returncode, "wrong": wrong(done.returncode, truth), "said": done.stderr.strip()[-200:]}


def one_scene(tool, rng):
    scene_kind = rng.choice(list(files.WRITERS))
    how, mesh_kind = rng.choice(["pipe", "pipe", "pipe", "inside", "bplod", "collision", "occluder"]), rng.choice(list(files.READERS))
    question = {"collision": "convex", "inside": "inside", "occluder": "inside"}.get(how, "around")
    try:
        scene_path, scene = files.write(random_scene(rng, question), scene_kind, os.path.join(tool.work, "scene"), rng)
    except subprocess.CalledProcessError:  # Draco's encoder wants an area
        return {"scene": scene_kind, "refused": True}
    row = {"how": how, "scene": scene_kind}
    out = os.path.join(tool.work, "p." + mesh_kind)
    faces, resolution = rng.choice([12, 25, 60, 200]), rng.choice([6, 16, 33, 64])
    if how in ("pipe", "inside"):
        commands = [["bpvox", scene_path, "--resolution", resolution, *(["--fill", "inside"] if how == "inside" else ["--fill", rng.choice(["none", "flood", "winding"])]), "-o", "a.bpv"],
                    ["bpclose", "a.bpv", "--scale", rng.choice(["0", "1%", "5%", "20%"]), "--element", rng.choice(["cube", "ball"]), "-o", "b.bpv"],
                    ["bpmesh", "b.bpv", "--faces", faces, *(rng.choice([[], ["--enclose", "closing"], ["--enclose", "input"]]) if how == "pipe" else []), "-o", out]]
    else:
        common = ["bplod", scene_path, "--resolution", resolution, "--name", "n", "-o", "out"]
        commands = [{"bplod": [*common, "--faces", faces, "--levels", "1"], "collision": [*common, "--profile", "collision", "--hulls", rng.choice([1, 4, 16])],
                     "occluder": [*common, "--profile", "occluder", "--faces", max(faces, 24)]}[how]]
        out = os.path.join(tool.work, "out", {"bplod": "n.glb", "collision": "n_unreal.glb", "occluder": "n_occluder.glb"}[how])
    for command in commands:
        done = tool(*command, "-q")
        if done.returncode != 0:
            bad = done.returncode not in (1, 2, 3, 4)
            return {**row, "exit": done.returncode, "at": command[0], "wrong": "other" if bad else "", "refused": True, "said": done.stderr.strip()[-200:]}
    done = tool("bpcheck", *{"around": [], "inside": ["--inside"], "convex": ["--convex"]}[question], scene_path, out)
    mesh = files.READERS[out.rsplit(".", 1)[1]](out)
    truth = judge(mesh, scene, question) if how != "occluder" else None
    lossy = done.returncode == 5  # single precision, or a format that only Assimp reads, which bpvox tells: the file's own coordinates may stick out
    bad = wrong(done.returncode, truth) or ("wrong made" if done.returncode == 1 or (truth is False and not lossy) else "")
    return {**row, "truth": truth, "exit": done.returncode, "faces": len(mesh), "wrong": bad, "said": done.stderr.strip()[-200:]}


def one(args, seed):
    work = tempfile.mkdtemp(prefix=f"adversary-{seed}-")
    try:
        row = {"mutants": one_mutant, "scenes": one_scene}[args.what](Tools(args.bin, work), random.Random(f"{args.what} {seed}"))
    except subprocess.TimeoutExpired as slow:
        row = {"wrong": "other", "said": f"no answer: {' '.join(map(str, slow.cmd))}"}
    row = {"seed": seed, **row}
    if row.get("wrong") and args.keep:
        shutil.copytree(work, os.path.join(args.keep, str(seed)), dirs_exist_ok=True)
    shutil.rmtree(work)
    return row


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("what", choices=["mutants", "scenes"])
    parser.add_argument("bin", type=os.path.abspath)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=10000)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--out")
    parser.add_argument("--keep")
    args = parser.parse_args()
    out, counts = open(args.out, "w") if args.out else sys.stdout, Counter()
    with concurrent.futures.ProcessPoolExecutor(args.jobs) as pool:
        for row in pool.map(one, [args] * args.count, range(args.first, args.first + args.count), chunksize=4):
            print(json.dumps(row), file=out, flush=True)
            key = "refused" if row.get("refused") else f"judge {row.get('truth')}, exit {row.get('exit')}"
            counts[row.get("wrong") or key] += 1
    for key, n in sorted(counts.items()):
        print(f"{n:7} {key}", file=sys.stderr)
    return 1 if any(counts[k] for k in ("wrong holds", "wrong NO", "wrong made", "other")) else 0


if __name__ == "__main__":
    sys.exit(main())
