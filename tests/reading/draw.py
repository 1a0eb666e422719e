#!/usr/bin/env python3
"""Draws comments of the product for a reading test, each with the one line of code below it (not `template <...>`).
    tests/reading/draw.py [--seed N] [--count N] [ROOT]
Prints numbered questions as Markdown for a reader who has not seen the code: what does the comment say of that line? A second reader, who
has the code open, writes the key before; a third one compares. The same seed gives the same questions for the same sources. Drawn from are
comments of whole lines in lib, io, gpu and tools of at least four words; section marks and labels behind code are not."""
import argparse
import random
import re
import subprocess
import sys
from pathlib import Path

ROOMS = ("lib/", "io/", "gpu/", "tools/")
SOURCES = (".h", ".cpp", ".cu", ".cuh")
FEWEST_WORDS = 4


def comments_of(text):
    """(line number, words of the comment, line below it) of each comment that stands alone and above a line of code."""
    lines, i = text.split("\n"), 0
    while i < len(lines):
        begin, words = i, []
        while i < len(lines) and re.match(r"\s*///?(?!/)", lines[i]):
            words.append(re.sub(r"^\s*///? ?", "", lines[i]))
            i += 1
        if words and i < len(lines) and re.match(r"\s*template <.*>$", lines[i]):
            i += 1
        if words and i < len(lines) and lines[i].strip():
            yield begin + 1, "\n".join(words), lines[i].strip()
        i += 1


def all_comments(root):
    run = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=True)
    found = []
    for name in sorted(run.stdout.split("\n")):
        if not name.startswith(ROOMS) or not name.endswith(SOURCES):
            continue
        for line, comment, below in comments_of((root / name).read_text(encoding="utf-8")):
            if len(comment.split()) >= FEWEST_WORDS and not comment.startswith("---"):
                found.append((name, line, comment, below))
    return found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("root", nargs="?", default=Path(__file__).resolve().parent.parent.parent, type=Path)
    options = parser.parse_args()
    found = all_comments(options.root)
    if len(found) < options.count:
        sys.exit(f"{len(found)} comments, {options.count} wanted")
    drawn = sorted(random.Random(options.seed).sample(found, options.count))
    for number, (name, line, comment, below) in enumerate(drawn, 1):
        print(f"**{number}.** `{name}:{line}`\n```\n{comment}\n=> {below}\n```\n")


if __name__ == "__main__":
    main()
