#!/usr/bin/env python3
"""Runs the examples of a page as they stand there.
    tests/api/run_guide.py library.md CC CXX [INCLUDE]      BP_LIBRARY names libbp.so; without INCLUDE both are installed, and pkg-config finds them
    tests/api/run_guide.py README.md                        only those in Python
The arrays `vertices` and `triangles`, and scene.ply, hold a torus."""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from scenes import torus, write_ply


def main():
    page, compilers = Path(sys.argv[1]).read_text(encoding="utf-8"), dict(zip(("c", "cpp"), sys.argv[2:4]))
    if not compilers:
        linked = []
    elif len(sys.argv) > 4:
        library = Path(os.environ["BP_LIBRARY"])
        linked = ["-I", Path(sys.argv[4]).resolve(), library, f"-Wl,-rpath,{library.parent}"]
    else:
        linked = subprocess.run(["pkg-config", "--cflags", "--libs", "bp"], capture_output=True, text=True, check=True).stdout.split()
    options = {"c": ["-std=c99"], "cpp": ["-std=c++17"]}
    ran = dict.fromkeys(["python", *compilers], 0)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        names = dict(zip(("vertices", "triangles"), torus()))
        write_ply("scene.ply", **names)
        for language, code in re.findall(r"```(\w+)\n(.*?)```", page, flags=re.S):
            if language == "python":
                exec(compile(code, sys.argv[1], "exec"), names)  # the lines of our own guide
            elif language in compilers:
                source = Path(f"program.{language}")
                source.write_text(code, encoding="utf-8")
                subprocess.run([compilers[language], *options[language], "-Wall", "-Wextra", "-Werror", source, *linked, "-o", f"./{language}"], check=True)
                subprocess.run([f"./{language}"], check=True)
            else:
                continue
            ran[language] += 1
    print("ran", ran)
    return 0 if min(ran.values()) > 0 and (not compilers or ran["python"] >= 6) else 1


if __name__ == "__main__":
    sys.exit(main())
