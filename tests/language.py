#!/usr/bin/env python3
"""How long the sentences are, of manuals and pages, of --help and of the comments on public declarations.
    tests/language.py [--bar] [ROOT]
Prints, for each kind of text and for each page, the number of sentences, the median of their words, the share above 40
words, and the words of a page. --bar: exit status 1 unless over everything the median is at most 15, fewer than 3 % are
above 40, and no manual has more than 1,200 words. Code blocks, tables and headings do not count."""
import re
import subprocess
import sys
from pathlib import Path

LONG, MEDIAN, SHARE, MANUAL = 40, 15, 3.0, 1200


def sentences(text):
    """Numbers of words; an item of a list begins a sentence."""
    found = []
    for paragraph in re.split(r"\n\s*\n|\n\s*(?:[-*]|\d+\.) ", text):
        for sentence in re.split(r"(?<=[.!?:])\s+", paragraph.replace("\n", " ")):
            words = len(sentence.split())
            if words > 2:
                found.append(words)
    return found


def page_text(text):
    text = re.sub(r"```.*?```", "", text, flags=re.S)
    return "\n".join(line for line in text.split("\n") if not line.lstrip().startswith(("|", "#", "![")) and not line.startswith("    "))


def comment_text(text):
    """Comments with three slashes; each run of lines is a paragraph."""
    out = []
    for line in text.split("\n"):
        match = re.search(r"///<? ?(.*)$", line)
        if match:
            alone = line.lstrip().startswith("///")
            out.append(match.group(1) if alone else "\n\n" + match.group(1))
        else:
            out.append("")
    return "\n".join(out)


def help_text(text):
    """What sources hand to Args: the strings of calls of option(), flag(), positional() and about()."""
    out = []
    for call in re.finditer(r"args\.(?:option|flag|flag_with_word|positional|about)\((.*?)\);", text, flags=re.S):
        joined = re.sub(r'"\s*\n?\s*"', "", call.group(1))
        strings = re.findall(r'"((?:[^"\\]|\\.)*)"', joined)
        if strings:
            out.append(max(strings, key=len))
    return "\n\n".join(out)


def row(name, counts, words=None):
    if not counts:
        return
    counts = sorted(counts)
    share = 100 * sum(n > LONG for n in counts) / len(counts)
    print(f"{name:44} {len(counts):6} {counts[len(counts) // 2]:6} {share:8.1f}" + (f" {words:7}" if words else ""))


def main():
    arguments = [a for a in sys.argv[1:] if a != "--bar"]
    root = Path(arguments[0] if arguments else Path(__file__).resolve().parent.parent)
    tracked = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=True).stdout.split("\n")
    print(f"{'':44} {'count':>6} {'median':>6} {'% > 40':>8} {'words':>7}")
    everything, manuals = [], []
    kinds = {"pages": [], "comments": [], "help": []}
    for name in filter(None, tracked):
        path = root / name
        if name.endswith(".md"):
            text = page_text(path.read_text(encoding="utf-8"))
            counts = sentences(text)
            row(name, counts, len(text.split()))
            kinds["pages"] += counts
            if re.search(r"\.1\.md$", name):
                manuals.append((len(text.split()), name))
        elif name.endswith(".h") and not name.startswith("tests/"):
            kinds["comments"] += sentences(comment_text(path.read_text(encoding="utf-8")))
        elif name.startswith("tools/") and name.endswith(".cpp"):
            kinds["help"] += sentences(help_text(path.read_text(encoding="utf-8")))
    for kind, counts in kinds.items():
        row(kind, counts)
        everything += counts
    row("everything", everything)
    everything.sort()
    bad = everything[len(everything) // 2] > MEDIAN or 100 * sum(n > LONG for n in everything) / len(everything) >= SHARE
    for words, name in manuals:
        if words > MANUAL:
            print(f"{name}: {words} words, {MANUAL} at most")
            bad = True
    return 1 if bad and "--bar" in sys.argv else 0


if __name__ == "__main__":
    sys.exit(main())
