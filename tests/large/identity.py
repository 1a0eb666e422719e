#!/usr/bin/env python3
"""GLB files whose nodes have no transform: of every model, by the pipe and by bplod.

usage: identity.py BIN_DIR [--models DIR] [--only SUBSTRING]

One line for each model, tab-separated: what the nodes of its level have by `bpvox --resolution 96 | bpclose | bpmesh`, and by
`bplod --voxel 1.37%`: nothing, a translation alone, or more. A model that no tool reads has the exit status in place of that. Exit 1
if a file has more than a translation, or if the two ways differ.
"""
import argparse
import json
import os
import struct
import subprocess
import sys
import tempfile

FACES = "500"


def nodes_have(path):
    """What the nodes of a GLB have: nothing, translation, or more."""
    with open(path, "rb") as file:
        length, = struct.unpack("<I", file.read(20)[12:16])
        nodes = json.loads(file.read(length)).get("nodes", [])
    found = {key for node in nodes for key in ("matrix", "translation", "rotation", "scale") if key in node}
    return "nothing" if not found else "translation" if found == {"translation"} else " ".join(sorted(found))


def by_pipe(tool, model, folder):
    level = os.path.join(folder, "level.glb")
    pipe = '"$1" "$4" --resolution 96 -q -j 1 | "$2" -q -j 1 | "$3" --faces "$6" -q -j 1 -o "$5"; set -- "${PIPESTATUS[@]}"; [ $1 = 0 ] || exit $1; exit $3'
    done = subprocess.run(["bash", "-c", pipe, "pipe", tool("bpvox"), tool("bpclose"), tool("bpmesh"), model, level, FACES], capture_output=True)
    return nodes_have(level) if done.returncode == 0 else f"exit {done.returncode}"


def by_bplod(tool, model, folder):
    out = os.path.join(folder, "lod")
    command = [tool("bplod"), model, "--voxel", "1.37%", "--faces", FACES, "--levels", "1", "--name", "level", "-q", "-j", "1", "-o", out]
    done = subprocess.run(command, capture_output=True)
    return nodes_have(os.path.join(out, "level_LOD0.glb")) if done.returncode == 0 else f"exit {done.returncode}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("bin")
    parser.add_argument("--models", default="models")
    parser.add_argument("--only", default="")
    args = parser.parse_args()
    tool = lambda name: os.path.join(args.bin, name)
    counts, wrong = {}, 0
    for name in sorted(os.listdir(args.models)):
        model = os.path.join(args.models, name)
        if name.endswith((".md", ".tsv", ".mtl")) or args.only not in name or not os.path.isfile(model):
            continue
        with tempfile.TemporaryDirectory() as folder:
            ways = by_pipe(tool, model, folder), by_bplod(tool, model, folder)
        print(name, *ways, sep="\t", flush=True)
        counts[ways] = counts.get(ways, 0) + 1
        wrong += ways[0] != ways[1] or not (ways[0] in ("nothing", "translation") or ways[0].startswith("exit"))
    for ways, count in sorted(counts.items(), key=lambda item: -item[1]):
        print(f"{count} models: {ways[0]} by the pipe, {ways[1]} by bplod")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
