#!/usr/bin/env python3
"""Simulates a farm from measured jobs: how long a scene takes on many nodes, what is moved, and what limits it.
  simulate.py MEASURED.txt [--triangles 1e10] [--cores 16] [--link 1e9] [--svg FILE]
MEASURED.txt: the output of tests/bench/farm.sh. All work is taken to grow with the triangles, and to use all cores of a node; the plan
uses one. LINK: bytes a second that the store of scene and cache gives to all nodes together."""
import argparse
import heapq
import math
import random
import re

PARTS = (("tiles", "#4477aa"), ("repeated by each job", "#ee8866"), ("plan, put together", "#bbbbbb"), ("check", "#ccbb44"), ("waiting for the store", "#aa3377"))


def measured(path):
    text = open(path).read()
    number = lambda pattern: float(re.findall(pattern, text, re.M)[-1])
    rows = [line.split("\t") for line in text[text.index("job\tchunks_kept"):].splitlines()[1:]]
    tiles, again = [], []
    for _, kept, chunks, processor, *stages in rows:
        share = [float(processor) * float(s) / max(1e-9, sum(map(float, stages))) for s in stages]
        tiles.append(share[3])
        again.append((int(kept) / int(chunks), sum(share[:3])))
    most = max(again)[0]
    again = sorted(seconds for kept, seconds in again if kept == most)  # what is repeated where others made most
    return {"triangles": number(r"^(\d+) triangles,"), "tiles": tiles, "again": again[len(again) // 2],
            "plan": number(r"^of the plan, bplod: ([\d.]+) s"), "make": number(r"^--make .*s, ([\d.]+) s"),
            "check": number(r"^of this, the check: .*s, ([\d.]+) s"),
            "scene_bytes": number(r"^plant.glb\t(\d+)"), "cache_bytes": number(r"^many/.cache\t(\d+)")}


def simulate(m, triangles, nodes, cores, link):
    grow = triangles / m["triangles"]
    ranges = round(max(nodes, min(8 * nodes, sum(m["tiles"]) / m["again"] / 5)))  # as samples/farm/plan.py
    work = sum(m["tiles"]) * grow / ranges  # of one range, on average
    draws = max(1, min(1000, round(len(m["tiles"]) * grow / ranges)))
    mean = sum(m["tiles"]) / len(m["tiles"])
    chance = random.Random(1)
    each = lambda: work * sum(chance.choices(m["tiles"], k=draws)) / draws / mean
    moved = m["scene_bytes"] * grow + m["cache_bytes"] * grow / 2  # to a job; half of the cache are voxels and closings
    again, load = m["again"] * grow / cores, moved * nodes / link  # all nodes load at the same time
    free = [0.0] * nodes
    for _ in range(ranges):  # the next range goes to the node that is free first
        begin = heapq.heappop(free)
        heapq.heappush(free, begin + load + again + each() / cores)
    most = -(-ranges // nodes)  # jobs of a node
    read = m["scene_bytes"] * grow * nodes / link
    check = m["check"] * grow / cores / nodes + again  # a part of it for each node
    spent = [max(free) - most * (again + load), most * again, (m["plan"] + m["make"] / cores) * grow, check, most * load + read]
    return spent, moved * ranges + m["scene_bytes"] * grow * nodes


def svg(columns, title):
    width, height, top = 720, 420, math.ceil(max(sum(spent) for _, spent in columns) / 3600)
    step, scale = (width - 90) / len(columns), (height - 110) / top
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" font-size="13">',
           f'<rect width="{width}" height="{height}" fill="white"/><text x="60" y="22" font-size="15">{title}</text>']
    for i in range(0, top + 1, max(1, top // 6)):
        y = height - 40 - i * scale
        out.append(f'<path d="M55 {y:.0f}H{width - 20}" stroke="#ddd"/><text x="48" y="{y + 4:.0f}" text-anchor="end">{i} h</text>')
    for i, (nodes, spent) in enumerate(columns):
        y = height - 40
        for seconds, (_, color) in zip(spent, PARTS):
            y -= seconds / 3600 * scale
            out.append(f'<rect x="{65 + i * step:.0f}" y="{y:.1f}" width="{step * .7:.0f}" height="{seconds / 3600 * scale:.1f}" fill="{color}"/>')
        out.append(f'<text x="{65 + (i + .35) * step:.0f}" y="{height - 22}" text-anchor="middle">{nodes}</text>')
    for i, (name, color) in enumerate(PARTS):
        x = 40 + 140 * i
        out.append(f'<rect x="{x}" y="36" width="12" height="12" fill="{color}"/><text x="{x + 18}" y="47">{name}</text>')
    return "\n".join(out + [f'<text x="{width / 2:.0f}" y="{height - 5}" text-anchor="middle">nodes</text></svg>', ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("measured")
    for name, value in (("--triangles", 1e10), ("--cores", 16), ("--link", 1e9)):
        parser.add_argument(name, type=float, default=value)
    parser.add_argument("--svg")
    o = parser.parse_args()
    m, columns = measured(o.measured), []
    print("nodes", "hours", *(name for name, _ in PARTS), "terabytes", sep="\t")
    for nodes in (1, 2, 4, 8, 16, 32, 64):
        spent, moved = simulate(m, o.triangles, nodes, o.cores, o.link)
        columns.append((nodes, spent))
        print(nodes, *(f"{s / 3600:.2f}" for s in [sum(spent), *spent]), f"{moved / 1e12:.1f}", sep="\t")
    if o.svg:
        with open(o.svg, "w") as file:
            file.write(svg(columns, f"{o.triangles:.0e} triangles on nodes of {o.cores:.0f} cores (simulated)"))


main()
