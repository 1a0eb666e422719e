#!/usr/bin/env python3
"""Processor time of the Python module against the pipe of the tools, whole processes in turns, the best of five.
    PYTHONPATH=tools/python BP_LIBRARY=build/release/tools/api/libbp.so.0 tests/api/overhead.py build/release/tools SCENE...
Prints a line for each scene: seconds of the tools, of the module with the file, with arrays from a file of NumPy, and of a process that only
imports NumPy and the module and opens the library; then by how much the calls take more than the tools, in percent, without that start. Says if
the bytes differ."""
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

RUNS, VOXELS, FACES = 5, 256, 1000
START = "import numpy, bounding_proxies as bp; bp.library_version()"
OF_FILE = "import sys, bounding_proxies as bp; bp.proxy(sys.argv[1], faces=%d, scale='1%%', resolution=%d).save(sys.argv[2], overwrite=True)"
OF_ARRAYS = ("import sys, numpy as np, bounding_proxies as bp; a = np.load(sys.argv[1]); "
             "bp.proxy(a['v'], a['t'], faces=%d, scale='1%%', resolution=%d).save(sys.argv[2], overwrite=True)")


def seconds(command, **how):
    """Processor time of a command and its children."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, **how)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    if len(sys.argv) < 3:
        print(__doc__)
        return 2
    tools, different = Path(sys.argv[1]).resolve(), 0
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        print("scene", "tools", "file", "arrays", "start", "file without start", "arrays without start", sep=" | ")
        for scene in sys.argv[2:]:
            pipe = (f"'{tools}/bpvox' \"$1\" --resolution {VOXELS} -q | '{tools}/bpclose' --scale 1% -q | "
                    f"'{tools}/bpmesh' --faces {FACES} -q --overwrite -o \"$2\"")
            save = "import sys, numpy as np, bounding_proxies as bp; m = bp.load(sys.argv[1])[0]; np.savez(sys.argv[2], v=m.vertices, t=m.triangles)"
            subprocess.run([sys.executable, "-c", save, scene, home / "a.npz"], check=True)
            commands = [["sh", "-c", pipe, "sh", scene, home / "0.ply"],
                        [sys.executable, "-c", OF_FILE % (FACES, VOXELS), scene, home / "1.ply"],
                        [sys.executable, "-c", OF_ARRAYS % (FACES, VOXELS), home / "a.npz", home / "2.ply"],
                        [sys.executable, "-c", START]]
            best = [min(t) for t in zip(*([seconds(c) for c in commands] for _ in range(RUNS)))]
            same = (home / "0.ply").read_bytes() == (home / "1.ply").read_bytes()
            different += not same
            tools_alone, of_file, of_arrays, start = best
            more = (f"{100 * ((t - start) / tools_alone - 1):+.1f} %" for t in (of_file, of_arrays))
            print(os.path.basename(scene), *(f"{t:.2f}" for t in best), *more, *([] if same else ["OTHER BYTES"]), sep=" | ", flush=True)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
