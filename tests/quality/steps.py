#!/usr/bin/env python3
"""Runs bplod apart for each of twelve budgets of faces, and counts the steps at which more faces make a level worse.

usage: steps.py BIN_DIR [--models DIR] [--set tune|choose|final|all] [--mode bounding|fit] [--jobs N] [--scenes N] [--out FILE.json]

A step is a pair of neighbouring budgets of a scene. It rises if the error, as bplod measures it, is larger by more than 5 % with the larger
budget; for levels that enclose, their volume is counted, too. `--scenes N` takes the first N scenes. The last line sums up."""
import argparse
import concurrent.futures
import json
import os
import subprocess
import sys
import tempfile

import run as quality

BUDGETS = [12, 16, 24, 36, 60, 100, 160, 300, 700, 1500, 4000, 10000]
RISE = 1.05


def level(args, work, scene, budget):
    """Faces, error and volume of the level; None where there is none."""
    name, _, source = scene
    path = os.path.join(work, name + ".obj") if source == "generated" else os.path.join(args.models, source)
    out = os.path.join(work, f"{name}-{budget}")
    report = out + ".json"
    command = [os.path.join(args.bin, "bplod"), path, *quality.MODES[args.mode], "--faces", str(budget), "--levels", "1", "--appearance", "off", "--name", "s",
               "-o", out, "--report", report, "-q", "-j", "1"]
    if subprocess.run(command, capture_output=True, check=False).returncode != 0:
        return None
    with open(report, encoding="utf-8") as f:
        made = json.load(f)["counts"]["levels"][0]
    return made["faces"], made["error"], made["volume"]


def rises(levels, column):
    """Pairs of budgets whose larger one has the larger value."""
    known = [(budget, made[column]) for budget, made in zip(BUDGETS, levels) if made is not None]
    return [(few, many, b / a) for (few, a), (many, b) in zip(known, known[1:]) if b > RISE * a], max(len(known) - 1, 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin")
    parser.add_argument("--models", default=os.environ.get("BP_MODELS", "../shared/models"))
    parser.add_argument("--set", default="tune")
    parser.add_argument("--mode", default="bounding", choices=["bounding", "fit"])
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--scenes", type=int, default=1000)
    parser.add_argument("--out")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="steps-") as work:
        subprocess.run([sys.executable, os.path.join(quality.HERE, "scenes.py"), work], check=True)
        scenes = [s for s in quality.scenes_of(args.set) if s[2] == "generated" or os.path.exists(os.path.join(args.models, s[2]))][:args.scenes]
        jobs = [(scene, budget) for budget in reversed(BUDGETS) for scene in scenes]  # the slow ones first
        with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
            made = dict(zip(((s[0], b) for s, b in jobs), pool.map(lambda job: level(args, work, *job), jobs)))
    table = {scene[0]: [made[scene[0], budget] for budget in BUDGETS] for scene in scenes}
    if args.out:
        with open(args.out, "w", encoding="utf-8") as f:
            json.dump({"budgets": BUDGETS, "levels": table}, f, indent=1)
    for column, what in [(1, "error")] + ([(2, "volume")] if args.mode == "bounding" else []):
        count = steps = 0
        for name, levels in table.items():
            risen, all_steps = rises(levels, column)
            count, steps = count + len(risen), steps + all_steps
            for few, many, ratio in risen:
                print(f"{name}: {what} x {ratio:.2f} from {few} to {many} faces")
        print(f"{what}: {count} of {steps} steps rise by more than 5 %, {100 * count / max(steps, 1):.1f} %")


if __name__ == "__main__":
    main()
