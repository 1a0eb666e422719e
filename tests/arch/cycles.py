#!/usr/bin/env python3
"""Measures the includes of the product: units that include each other in a ring, and the longest chain of includes.
    tests/arch/cycles.py [--list] [ROOT]
A unit is a header with the source of its name. Units of a ring cannot be read, tested or compiled one after the other. Both numbers have a
bound, which may only fall: exit status 1 if a number is not its bound. --list: the rings and the longest chain."""
import re
import subprocess
import sys
from pathlib import Path

RINGS, UNITS_IN_RINGS, DEPTH = 0, 0, 16  # 29 November 2026: of 21 rings with 63 units, and 26 files
ROOMS, SOURCES = ("lib/", "io/", "gpu/", "tools/"), (".h", ".cpp", ".cu", ".cuh")


def unit_of(name):
    return name.rsplit(".", 1)[0]


def includes_of(root, files):
    known = set(files)
    return {name: [h for h in re.findall(r'^\s*#include "([^"]+)"', (root / name).read_text(encoding="utf-8"), re.M) if h in known]
            for name in files}


def rings_of(graph):
    """The strongly connected components of more than one unit (Tarjan 1972)."""
    index, low, stack, on_stack, rings = {}, {}, [], set(), []

    def visit(unit):
        index[unit] = low[unit] = len(index)
        stack.append(unit)
        on_stack.add(unit)
        for other in sorted(graph[unit]):
            if other not in index:
                visit(other)
                low[unit] = min(low[unit], low[other])
            elif other in on_stack:
                low[unit] = min(low[unit], index[other])
        if low[unit] == index[unit]:
            ring = []
            while not ring or ring[-1] != unit:
                ring.append(stack.pop())
                on_stack.discard(ring[-1])
            if len(ring) > 1:
                rings.append(sorted(ring))

    for unit in sorted(graph):
        if unit not in index:
            visit(unit)
    return rings


def longest_chain(includes):
    chains = {}

    def chain(name):
        if name not in chains:
            chains[name] = [name]  # a header that includes itself ends here
            chains[name] = [name] + max((chain(h) for h in includes[name]), key=len, default=[])
        return chains[name]

    return max((chain(name) for name in sorted(includes)), key=len)


def main():
    sys.setrecursionlimit(10000)
    arguments = [a for a in sys.argv[1:] if not a.startswith("--")]
    root = Path(arguments[0] if arguments else Path(__file__).resolve().parent.parent.parent)
    run = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=False)
    files = [name for name in run.stdout.split("\n") if name.startswith(ROOMS) and name.endswith(SOURCES) and (root / name).exists()]
    if not files:
        print("SKIPPED: no clone of the repository")
        return 0
    includes = includes_of(root, files)
    graph = {unit_of(name): set() for name in files}
    for name, headers in includes.items():
        graph[unit_of(name)] |= {unit_of(h) for h in headers if unit_of(h) != unit_of(name)}
    rings, chain = rings_of(graph), longest_chain(includes)
    measured = (len(rings), sum(map(len, rings)), len(chain))
    print("{} rings of {} units, a depth of {} files".format(*measured))
    bad = measured != (RINGS, UNITS_IN_RINGS, DEPTH)
    if bad or "--list" in sys.argv:
        for ring in rings:
            print(f"{len(ring)}: " + ", ".join(ring))
        print(" -> ".join(chain))
    if bad:
        print(f"the bound is {RINGS} rings of {UNITS_IN_RINGS} units and {DEPTH} files; where a number has fallen, lower it in {Path(__file__).name}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
