#!/usr/bin/env python3
"""Checks that the contracts which manuals name are rows of docs/contracts.md, and those that files carry.
    tests/arch/contracts.py [ROOT]
Looks at the tables of manuals with a column "contract", and at the names in io/mesh/contract.cpp. Exit status 1 if one is unknown, or if a manual of a
tool that writes meshes has no such table."""
import re
import sys
from pathlib import Path

root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent.parent)


def text(name):
    return (root / name).read_text(encoding="utf-8")


rows = set(re.findall(r"^\| `([^`]+)` \|", text("docs/contracts.md").split("## Who writes which")[0], re.M))
carried = set(re.findall(r'Row\{Contract::\w+, "([^"]+)"', text("io/mesh/contract.cpp")))
wrong = [f"io/mesh/contract.cpp and docs/contracts.md differ: {name}" for name in sorted(rows ^ carried)]
named = 0
for manual in ("docs/bplod.1.md", "docs/bpmesh.1.md"):
    table = re.search(r"^\|[^|\n]*\| contract \|\n((?:\|.*\n)+)", text(manual), re.M)
    for line in table.group(1).split("\n")[1:] if table else []:
        for name in re.findall(r"`([^`]+)`", line.split("|")[2] if line.count("|") > 2 else ""):
            named += 1
            if name not in rows:
                wrong.append(f"{manual}: {name} is no row of docs/contracts.md")
    if not table:
        wrong.append(f"{manual}: has no table of contracts")
print("\n".join(wrong) if wrong else f"{named} contracts in manuals are rows of docs/contracts.md")
sys.exit(1 if wrong or named < 8 else 0)
