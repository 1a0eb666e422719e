#!/usr/bin/env python3
"""The whole matrix: every model x scales x elements x faces, through the real tools, each proxy checked by bpcheck after reading it back.

usage: matrix.py BIN_DIR [--models DIR] [--resolution N] [--scales 1%,2%,4%] [--elements cube,ball] [--faces 300,1000]
                 [--only SUBSTRING] [--jobs N] [--out FILE.jsonl]

One JSON line per proxy (or per model that is refused, with its exit status and message). Exit 1 if any proxy fails its check, or a
tool ends in a way that the manuals do not name.
"""
import argparse
import concurrent.futures
import json
import os
import subprocess
import sys
import tempfile
import time


def run(command, **kwargs):
    return subprocess.run(command, capture_output=True, text=True, **kwargs)


def refused(done):
    """A clear refusal: status 3 and one line on stderr."""
    return done.returncode == 3 and len(done.stderr.strip().splitlines()) == 1


def one_model(args, path):
    name, rows = os.path.basename(path), []
    tool = lambda t: os.path.join(args.bin, t)
    with tempfile.TemporaryDirectory() as tmp:
        vox = os.path.join(tmp, "solid.bpv")
        start = time.time()
        done = run([tool("bpvox"), path, "--resolution", str(args.resolution), "-o", vox, "--threads", "1"])
        if done.returncode != 0:
            return [{"model": name, "refused": refused(done), "exit": done.returncode, "message": done.stderr.strip()[-300:], "ok": refused(done)}]
        warning, seconds_vox = done.stderr.strip(), time.time() - start
        for element in args.elements:
            for scale in args.scales:
                closed = os.path.join(tmp, "closed.bpv")
                start = time.time()
                done = run([tool("bpclose"), vox, "--scale", scale, "--element", element, "-o", closed, "--overwrite", "--threads", "1"])
                row = {"model": name, "element": element, "scale": scale}
                if done.returncode != 0:
                    rows.append({**row, "ok": False, "exit": done.returncode, "message": done.stderr.strip()[-300:]})
                    continue
                seconds_close = time.time() - start
                for faces in args.faces:
                    rows.append(one_proxy(args, tool, tmp, path, closed, faces, {**row, "warning": warning, "seconds_vox": round(seconds_vox, 3), "seconds_close": round(seconds_close, 3)}))
    return rows


def one_proxy(args, tool, tmp, path, closed, faces, row):
    proxy, report = os.path.join(tmp, "proxy.glb"), os.path.join(tmp, "report.json")
    start = time.time()
    done = run([tool("bpmesh"), closed, "--faces", str(faces), "-o", proxy, "--report", report, "--overwrite", "--threads", "1"])
    row = {**row, "faces_wanted": faces, "seconds_mesh": round(time.time() - start, 3)}
    if done.returncode != 0:
        return {**row, "ok": False, "exit": done.returncode, "message": done.stderr.strip()[-300:]}
    counts = json.load(open(report))["counts"]
    level = counts["levels"][0]
    start = time.time()
    check = run([tool("bpcheck"), path, proxy, "--json", "--threads", "1"])
    try:
        verdict = json.loads(check.stdout)
    except ValueError:
        return {**row, "ok": False, "exit": check.returncode, "message": check.stderr.strip()[-300:]}
    return {**row, "faces": level["faces"], "stopped_by": level["stopped_by"], "volume": level["volume"], "volume_of_voxels": counts["volume_of_voxels"],
            "seconds_check": round(time.time() - start, 3), "ok": check.returncode == 0, "exit": check.returncode,
            **({} if check.returncode == 0 else {"verdict": verdict})}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("bin")
    parser.add_argument("--models", default=os.environ.get("BP_MODELS", "../shared/models"))
    parser.add_argument("--resolution", type=int, default=256)
    parser.add_argument("--scales", type=lambda s: s.split(","), default=["1%", "2%", "4%"])
    parser.add_argument("--elements", type=lambda s: s.split(","), default=["cube", "ball"])
    parser.add_argument("--faces", type=lambda s: [int(f) for f in s.split(",")], default=[300, 1000])
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--out")
    args = parser.parse_args()
    skip = (".md", ".tsv")
    models = sorted(os.path.join(args.models, m) for m in os.listdir(args.models) if not m.endswith(skip) and args.only in m)
    bad, good, refusals = 0, 0, 0
    out = open(args.out, "w") if args.out else sys.stdout
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for rows in pool.map(lambda m: one_model(args, m), models):
            for row in rows:
                print(json.dumps(row), file=out, flush=True)
                bad += not row["ok"]
                good += row["ok"] and "faces" in row
                refusals += row["ok"] and "refused" in row
    print(f"{good} proxies hold, {refusals} files refused clearly, {bad} failures", file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
