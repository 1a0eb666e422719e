#!/usr/bin/env python3
"""The most memory that bpview takes itself, against --memory: while it opens a plant, closes it, and sends its surface to several pages.

usage: view_memory.py BIN_DIR [--triangles N] [--resolution N] [--memory SIZE] [--base LENGTH] [--strokes N]

BIN_DIR holds the tools and bp-plant. Pages ask for the whole surface at once, one of them reads slowly, and strokes follow. The tools that
bpview starts have as much memory each, and are not counted. Exit status 1 if the process has had more than --memory (VmHWM).
"""
import argparse, json, os, random, socket, subprocess, sys, tempfile, threading, time
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "view"))
from designs import pieces
from served import Served


def peak_of(process):
    with open(f"/proc/{process.pid}/status") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmHWM")) * 1024


def bytes_of(size):
    return int(float(size[:-1]) * 1024 ** "KMGT".index(size[-1].upper()) * 1024) if size[-1].upper() in "KMGT" else int(size)


def main():
    args = argparse.ArgumentParser()
    args.add_argument("bin_dir")
    args.add_argument("--triangles", type=int, default=3000000)
    args.add_argument("--resolution", type=int, default=1024)
    args.add_argument("--memory", default="400M")
    args.add_argument("--base", default="3%")
    args.add_argument("--strokes", type=int, default=3)
    o = args.parse_args()
    os.environ["PATH"] = os.path.abspath(o.bin_dir) + ":" + os.environ["PATH"]
    with tempfile.TemporaryDirectory(prefix="view_memory_") as folder:
        subprocess.run(["bp-plant", "--triangles", str(o.triangles), "--seed", "7", "-o", "plant.ply"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        with open(f"{folder}/rules.json", "w") as file:
            json.dump({"base": o.base}, file)
        begin = time.time()
        s = Served("plant.ply", "--rules", "rules.json", "--resolution", str(o.resolution), "--memory", o.memory, cwd=folder)
        s.enter()
        s.edit(op="live", live=False)
        s.post("/api/stop")
        closed = lambda q: q["closing"]["error"] or q["closing"]["shown"] == q["design"]["revision"]
        state = s.wait(closed, 900)
        if state["closing"]["error"]:
            print(state["closing"]["error"])
        print(f"closed after {time.time() - begin:.1f} s; peak {peak_of(s.process) / 2**20:.0f} MiB", flush=True)
        slow = socket.create_connection(("127.0.0.1", s.port))
        slow.send(f"GET /api/surface?after=0 HTTP/1.1\r\nHost: 127.0.0.1:{s.port}\r\nCookie: {s.cookie}\r\n\r\n".encode())
        answers = []
        pages = [threading.Thread(target=lambda: answers.append(s.ask("GET", "/api/surface?after=0")[2])) for _ in range(3)]
        begin = time.time()
        for page in pages:
            page.start()
        for page in pages:
            page.join()
        seconds, faces = time.time() - begin, sum(n for _, _, n, _ in pieces(answers[0])[1])
        generator, low, high = random.Random(1), state["scene"]["min"], state["scene"]["max"]
        for _ in range(o.strokes):
            s.edit(op="rule", rule={"at": [generator.uniform(a, b) for a, b in zip(low, high)], "radius": "3%", "scale": "0.5%", "mode": "decrease"})
            state = s.wait(closed, 900)
        s.ask("GET", "/api/scene")
        peak = peak_of(s.process)
        s.end()
        print(f"{o.triangles} triangles, {o.resolution} voxels, base {o.base}, --memory {o.memory}: peak {peak / 2**20:.0f} MiB; a surface of {faces} faces, "
              f"{len(answers[0]) / 1e6:.1f} MB, drawn in voxels {state['closing']['drawn_voxel'] / state['scene']['voxel']:.0f} times as large, three at once in {seconds:.1f} s")
        sys.exit(peak > bytes_of(o.memory))


main()
