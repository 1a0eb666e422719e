#!/usr/bin/env python3
"""Holds the sizes that the house keeps to: lines of a file, lines of a function's body, files of a folder.
    tests/arch/sizes.py [ROOT]
Prints what is larger; exit status 1 if there is any. A function's body begins where its signature ends; the style (clang-format)
decides what is one."""
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

FILE, FUNCTION, FOLDER = 400, 40, 27
# A kernel and what it calls on the device belong in one file, and in one piece: registers and inlining depend on it.
LONG_FILES = {"gpu/kernels/bit_kernels.cu", "gpu/kernels/row_kernels.cu", "tests/backend/hierarchical_kernels.cu"}
TABLES = {"text_of", "with_fields"}  # one case after the other, no step depends on another
# One file for each behaviour; pages that are only added to; decisions, which are found by their numbers.
FULL_FOLDERS = {"tests/golden/cases", "docs/lab", "docs/decisions"}
SOURCES = (".h", ".cpp", ".cu", ".cuh", ".py", ".sh", ".cmake")


def functions(lines):
    """Name, first line and lines of each function of a C++ file: indented by at most one class."""
    for at, line in enumerate(lines):
        if not line.endswith("{") or line.lstrip().startswith(("//", "}")):
            continue
        first = at
        while first > 0 and lines[first - 1].strip() and not re.search(r"[;{}:]$|^\s*(//|#)", lines[first - 1]):
            first -= 1
        signature = " ".join(part.strip() for part in lines[first:at + 1])
        indent = re.match(r" *", lines[first]).group()
        name = re.search(r"(?!decltype)\b([A-Za-z_]\w*|operator\S+)\(", signature)
        if len(indent) > 2 or not name or re.match(r"(namespace|class|struct|enum|extern|if|for|while|switch|do|else)\b", signature):
            continue
        if re.search(r"\]\s*\(|=\s*\{$", signature):  # a lambda, a list
            continue
        end = next((i for i in range(at + 1, len(lines)) if lines[i].startswith(indent + "}")), len(lines) - 1)
        yield name.group(1), at + 1, end - at + 1


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent.parent)
    run = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=False)
    files = [name for name in run.stdout.split("\n") if name and (root / name).exists()]
    if not files:
        print("SKIPPED: no clone of the repository")
        return 0
    found, checked = [], 0
    for name in files:
        if not name.endswith(SOURCES):
            continue
        lines = (root / name).read_text(encoding="utf-8").rstrip("\n").split("\n")
        if len(lines) > FILE and name not in LONG_FILES:
            found.append(f"{name}: {len(lines)} lines, {FILE} at most")
        if name.startswith("tests/") or not name.endswith((".h", ".cpp")):
            continue
        for function, line, size in functions(lines):
            checked += 1
            if size > FUNCTION and function not in TABLES:
                found.append(f"{name}:{line}: {function}() has {size} lines, {FUNCTION} at most")
    for folder, count in Counter(str(Path(name).parent) for name in files).items():
        if count > FOLDER and folder not in FULL_FOLDERS:
            found.append(f"{folder}: {count} files, {FOLDER} at most")
    print("\n".join(found) if found else f"{checked} functions in {len(files)} files are small")
    return 1 if found or checked < 1000 else 0


if __name__ == "__main__":
    sys.exit(main())
