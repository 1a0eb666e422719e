#!/usr/bin/env python3
"""Finds constants of one name and two values that may meet.
    tests/arch/constants.py [ROOT]
A constant of a header, at the level of a namespace, has its name alone: another one of that name and with another value, in a header or at the
level of a namespace in a source, is read for the first one, and decides by the order of includes. Exit status 1 if there is any."""
import re
import subprocess
import sys
from pathlib import Path

ROOMS, SOURCES = ("lib/", "io/", "gpu/", "tools/"), (".h", ".cpp", ".cu", ".cuh")


def constants(text):
    """Name and value of each constant that begins in the first column."""
    text = re.sub(r"//[^\n]*", "", text)
    for declared in re.finditer(r"^(?:inline |static )?constexpr\s+[^;=()]*?\b(k[A-Z]\w*\s*[{=][^;]*);", text, re.M):
        for part in re.split(r",\s*(?=k[A-Z]\w*\s*[{=])", declared.group(1)):
            found = re.match(r"(k[A-Z]\w*)\s*[{=]\s*(.*)$", part, re.S)
            if found:
                yield found.group(1), re.sub(r"\s+", " ", found.group(2)).strip()


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent.parent)
    run = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=False)
    files = [name for name in run.stdout.split("\n") if name.startswith(ROOMS) and name.endswith(SOURCES) and (root / name).exists()]
    if not files:
        print("SKIPPED: no clone of the repository")
        return 0
    places, count = {}, 0
    for name in files:
        for constant, value in constants((root / name).read_text(encoding="utf-8")):
            count += 1
            if not value.endswith("::" + constant):  # an alias
                places.setdefault(constant, []).append((value, name))
    bad = {k: v for k, v in places.items() if len({value for value, _ in v}) > 1 and any(name.endswith(".h") for _, name in v)}
    for constant, found in sorted(bad.items()):
        print(f"{constant}: " + "; ".join(f"{value} in {name}" for value, name in found))
    if not bad:
        print(f"{count} constants at the level of namespaces have one value")
    return 1 if bad or count < 500 else 0


if __name__ == "__main__":
    sys.exit(main())
