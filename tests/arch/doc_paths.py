#!/usr/bin/env python3
"""Finds paths and names of files in documents that are not in the tree (any more).
    tests/arch/doc_paths.py [ROOT]
Looks at words in code marks (`...`): a path that begins with a folder of the tree must exist, and the name of a source or script must be that of a
file somewhere. The lab books are left out: they tell of files as they were. Exit status 1 if there is any."""
import re
import subprocess
import sys
from pathlib import Path

PLACEHOLDERS = {"NAME", "YYYY-MM-DD"}


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent.parent)
    run = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=False)
    files = {name for name in run.stdout.split("\n") if name and (root / name).exists()}
    if not files:
        print("SKIPPED: no clone of the repository")
        return 0
    names = {Path(name).name for name in files}
    folders = {str(parent) for name in files for parent in Path(name).parents}
    found, checked = [], 0
    for page in sorted(name for name in files if name.endswith(".md") and not name.startswith("docs/lab/")):
        for code in re.findall(r"`([^`\n]+)`", (root / page).read_text(encoding="utf-8")):
            for word in re.findall(r"[\w./*-]+", code):
                word = word.rstrip("./")
                if any(p in word for p in PLACEHOLDERS):
                    continue
                if re.match(r"(lib|io|gpu|tools|tests|samples|docs|cmake)/", word):
                    pattern = re.compile(re.escape(word).replace(r"\*", ".*") + r"(\.(h|cpp))?$")
                    known = word in folders or any(pattern.match(name) for name in files)
                elif re.match(r"[\w-]+\.(h|cpp|cu|cuh|py|sh|cmake)$", word):
                    known = word in names
                else:
                    continue
                checked += 1
                if not known:
                    found.append(f"{page}: {word} is not in the tree")
    print("\n".join(found) if found else f"{checked} paths and names in documents exist")
    return 1 if found or checked < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
