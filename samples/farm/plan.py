#!/usr/bin/env python3
"""Prints the jobs of a scene's tileset as JSON, from what bplod --explain says.
  plan.py SCENE MACHINES [--memory SIZE] [OPTION...]    OPTIONs go to bplod
memory: bytes that each job keeps to; 0: not known. ranges: of tiles, as for --tiles; about 30 s of work (BATCH) each or more, and at most
eight for each machine. Scenes that bplod cannot read, and levels that are no tiles, have none."""
import json
import math
import os
import subprocess
import sys
import tempfile

SECONDS = float(os.environ.get("BATCH", 30))
RANGES_PER_MACHINE = 8
SECONDS_PER_FACE = 1.1e-5     # of the voxels' surface in all tiles, on one core
FACES_PER_SQUARE = 3.6        # of all levels, for each square of a voxel's size in the scene's area
SECONDS_PER_TRIANGLE = 5e-7   # of the scene, which each job reads, with its voxels and closings: rather a fifth of its time than more


def main():
    scene, machines, *options = sys.argv[1:]
    with tempfile.NamedTemporaryFile(suffix=".json") as report:
        command = ["bplod", scene, *options, "--explain", "-q", "--overwrite", "--report", report.name]
        told = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if told.returncode not in (0, 2, 3):  # of the machine, not of the scene: to be tried again
            sys.exit(told.stderr)
        plan = json.load(open(report.name)) if told.returncode == 0 else None
    print(json.dumps({"memory": plan["options"]["memory"] if plan else 0, "ranges": ranges(plan, int(machines))}))


def ranges(plan, machines):
    if plan is None or plan["options"]["profile"] != "3dtiles":
        return []
    counts = plan["counts"]
    work = counts["area"] / counts["voxel"] ** 2 * FACES_PER_SQUARE * SECONDS_PER_FACE
    worth = work / (5 * SECONDS_PER_TRIANGLE * counts["triangles"])
    number = min(math.ceil(work / SECONDS), max(machines, min(int(worth), RANGES_PER_MACHINE * machines)))
    if number > machines:
        number = math.ceil(number / machines) * machines  # else some machines wait for the last ranges of others
    number = min(number, counts["jobs"])
    if number < 2:
        return []
    edges = cut(counts, number)
    return [f"{a}..{b}" for a, b in zip(edges, edges[1:])]


def cut(counts, number):
    """Edges of ranges of about the same work: a level has a quarter of the surface of the level before."""
    weights = [0] * counts["jobs"]
    for i, level in enumerate(counts["levels"]):
        tiles = level.get("tiles_at_most", 1)
        for n in range(tiles):
            weights[level["first_number"] + n] += 4**-i / tiles
    edges, done, all_ = [0], 0, sum(weights)
    for n, weight in enumerate(weights):
        done += weight
        if done >= all_ * len(edges) / number:
            edges.append(n + 1)
    return sorted({*edges[:number], len(weights)})


main()
