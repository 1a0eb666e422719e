#!/usr/bin/env python3
"""The table of quality: scenes x modes x budgets of faces through bplod, each level measured by `measure`.

usage: run.py BIN_DIR MEASURE [--models DIR] [--set tune|choose|final|quick|all] [--share N] [--only TEXT] [--jobs N] [--limit SECONDS]
              [--out FILE.csv] [--against OLD.csv]
       run.py --compare OLD.csv NEW.csv [--loss PERCENT]

--share 10 takes a fixed tenth of the cells. A row is a level: its cell, what `measure` says, and processor seconds and peak memory (MiB) of
the run, which one cell has for all of its levels. `--limit` ends a cell after so much time; its row says so.
--compare prints the mean change of each column for cells that both tables have, and the worst cells; exit 1 if the mean of `error` or `volume`
is worse by more than the loss, or one cell by more than ten times that. --against does so with what was just measured.

Sets: what is tuned is tuned on `tune`; what is chosen is chosen with `choose`; `final` is run once, when all is done. `quick` is the part of `tune` that
tests run. Which scene is in which set is in scenes.tsv, and stays."""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))
MODES = {"bounding": [], "fit": ["--mode", "fit"], "collision": ["--profile", "collision"], "occluder": ["--profile", "occluder"], "cage": ["--profile", "cage"]}
BUDGETS = {"bounding": [12, 30, 60, 120, 300, 1000, 4000, 40000], "fit": [30, 120, 1000, 40000], "collision": [30, 120, 500, 2000], "occluder": [24, 100], "cage": [300, 1000]}
FILES = {"bounding": "s_LOD0.glb", "fit": "s_LOD0.glb", "collision": "s_godot.glb", "occluder": "s_occluder.glb", "cage": "s_cage.glb"}
KEY = ["scene", "mode", "budget"]
MEASURES = ["faces", "volume", "error", "to_scene", "from_scene", "thin", "crumple", "silhouette", "sticks_out"]
COLUMNS = ["set", *KEY, *MEASURES, "seconds", "peak_mib", "remark"]
HIGHER_IS_BETTER = {"silhouette"}


def scenes_of(wanted):
    with open(os.path.join(HERE, "scenes.tsv")) as f:
        rows = [line.rstrip("\n").split("\t") for line in f if line.strip() and not line.startswith("#")]
    return [(name, which, source) for name, which, source in rows if which == wanted or (wanted == "tune" and which == "quick") or wanted == "all"]


def cells_of(args):
    cells = [(name, which, source, mode, budget) for name, which, source in scenes_of(args.set) for mode in MODES for budget in BUDGETS[mode]
             if not (which == "quick" and args.set == "quick" and (budget > 1000 or mode in ("occluder", "cage")))]
    chosen = lambda cell: zlib.crc32(f"{cell[0]} {cell[3]} {cell[4]}".encode()) % args.share == 0
    return [cell for cell in cells if chosen(cell) and args.only in f"{cell[0]} {cell[3]} {cell[4]}"]


def limited(command, seconds):
    """Exit code, stderr, processor seconds and peak memory of a command."""
    with tempfile.TemporaryFile("w+") as err:
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=err, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5)))
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        err.seek(0)
        return child.returncode, err.read().strip(), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def one(args, cell):
    name, which, source, mode, budget = cell
    row = {"set": which, "scene": name, "mode": mode, "budget": budget}
    path = os.path.join(args.work, name + ".obj") if source == "generated" else os.path.join(args.models, source)
    if not os.path.exists(path):
        return {**row, "remark": "not here"}
    out = os.path.join(args.work, f"{name}-{mode}-{budget}")
    command = [os.path.join(args.bin, "bplod"), path, *MODES[mode], "--faces", str(budget), "--name", "s", "-o", out, "-q", "-j", "1"]
    if mode in ("bounding", "fit"):
        command += ["--levels", "1", "--appearance", "off"]
    code, err, seconds, peak = limited(command, args.limit)
    row.update(seconds=f"{seconds:.2f}", peak_mib=f"{peak:.0f}")
    if code != 0:
        return {**row, "remark": "over the limit" if code < 0 else err.split(": ", 1)[-1][:80]}
    done = subprocess.run([args.measure, path, os.path.join(out, FILES[mode])], capture_output=True, text=True)
    shutil.rmtree(out)
    if done.returncode != 0:
        return {**row, "remark": done.stderr.strip()[:80]}
    measured = json.loads(done.stdout)
    return {**row, **{key: measured[key] for key in MEASURES}}


def run(args):
    cells = cells_of(args)
    args.work = tempfile.mkdtemp(prefix="quality-")
    subprocess.run([sys.executable, os.path.join(HERE, "scenes.py"), args.work], check=True)
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        rows = list(pool.map(lambda cell: one(args, cell), cells))
    shutil.rmtree(args.work)
    if args.out or not args.against:
        with open(args.out, "w", newline="") if args.out else sys.stdout as f:
            table = csv.DictWriter(f, COLUMNS, lineterminator="\n")
            table.writeheader()
            table.writerows(rows)
    return compare(read(args.against), by_cell(rows), args.loss) if args.against else 0


def by_cell(rows):
    return {tuple(str(row[k]) for k in KEY): {key: str(value) for key, value in row.items()} for row in rows}


def read(path):
    with open(path, newline="") as f:
        return by_cell(csv.DictReader(f))


def change(key, old, new):
    """In percent; positive is worse. None where one of both has no number."""
    if not old.get(key) or not new.get(key):
        return None
    a, b = float(old[key]), float(new[key])
    if key in HIGHER_IS_BETTER:
        return 100 * (a - b)
    least = {"thin": .01, "crumple": 1, "error": 1e-4, "to_scene": 1e-5, "from_scene": 1e-5, "sticks_out": 1e-3, "seconds": .05}.get(key, 1e-12)
    return 100 * math.log((abs(b) + least) / (abs(a) + least))


def compare(old, new, loss):
    both = [k for k in old if k in new]
    lost = [k for k in both if old[k].get("faces") and not new[k].get("faces")]
    print(f"{len(both)} cells in both; {len(lost)} that had a level have none now")
    bad = bool(lost)
    for key in [*MEASURES, "seconds", "peak_mib"]:
        changes = sorted((c, k) for k in both if (c := change(key, old[k], new[k])) is not None)
        if not changes:
            continue
        mean = sum(c for c, _ in changes) / len(changes)
        worst = "; ".join(f"{' '.join(k)} {c:+.1f}" for c, k in changes[:-4:-1] if c > 0)
        print(f"{key:17} mean {mean:+7.2f} %   90 % {changes[int(.9 * len(changes))][0]:+7.1f} %   worst: {worst}")
        if key in ("error", "volume") and (mean > loss or changes[-1][0] > 10 * loss):
            bad = True
    return 1 if bad else 0


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("bin", nargs="?")
    parser.add_argument("measure", nargs="?")
    parser.add_argument("--models", default=os.environ.get("BP_MODELS", "../shared/models"))
    parser.add_argument("--set", default="tune", choices=["tune", "choose", "final", "quick", "all"])
    parser.add_argument("--share", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--out")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--limit", type=int, default=300)
    parser.add_argument("--against")
    parser.add_argument("--compare", nargs=2)
    parser.add_argument("--loss", type=float, default=2.0)
    args = parser.parse_args()
    if args.compare:
        return compare(*map(read, args.compare), args.loss)
    return run(args)


if __name__ == "__main__":
    sys.exit(main())
