#!/usr/bin/env python3
"""Prints the jobs of a scene's tileset as JSON, from what bplod --explain says.
  plan.py SCENE MACHINES [--memory SIZE] [OPTION...]    OPTIONs go to bplod
memory: bytes that each job keeps to; 0: not known. ranges: of tiles, as for --tiles, of about the same work: one for each machine, or as
many as take BATCH (30) seconds with THREADS (1), but at most eight for each. checks: parts of the check (bpcheck --part). One machine has none of both: it makes
the scene in one job. So are scenes that bplod cannot read, and levels that are no tiles."""
import json
import math
import os
import subprocess
import sys
import tempfile

SECONDS, THREADS = float(os.environ.get("BATCH", 30)), int(os.environ.get("THREADS", 1))
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
    parts = ranges(plan, int(machines))
    print(json.dumps({"memory": plan["options"]["memory"] if plan else 0, "ranges": parts, "checks": int(machines) if parts else 0}))


def ranges(plan, machines):
    if plan is None or plan["options"]["profile"] != "3dtiles" or machines < 2:
        return []
    counts = plan["counts"]
    work = counts["area"] / counts["voxel"] ** 2 * FACES_PER_SQUARE * SECONDS_PER_FACE
    worth = work / (5 * SECONDS_PER_TRIANGLE * counts["triangles"])
    most = min(counts["jobs"], int(worth), RANGES_PER_MACHINE * machines, 1000)
    if most < 2 or work < SECONDS:
        return []
    number = min(most, math.ceil(work / THREADS / SECONDS / machines) * machines)  # each machine gets as many as the others
    edges = [counts["thousandths"][1000 * i // number] for i in range(number)] + [counts["jobs"]]
    return [f"{a}..{b}" for a, b in zip(edges, edges[1:]) if a < b]


main()
