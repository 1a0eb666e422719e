#!/usr/bin/env python3
"""How long the sentences are, of manuals and pages, of messages and of the comments on public declarations. The section OPTIONS of
manuals is what --help prints.
    tests/language.py [--bar] [--long] [ROOT]
Prints, for each kind of text and for each page, the number of sentences, the median of their words, the share above 40
words, and the words of a page. --long: also the sentences above 40 words, and words to avoid, with their files. --bar:
exit status 1 unless each kind keeps to BARS, no manual has more than 1,200 words, no page, message or comment has words to avoid, and no
sentence of a comment begins with a line of language_starts.txt. Code blocks, tables and headings do not count. Comments behind code are
labels: sentences begin with a capital letter."""
import re
import subprocess
import sys
from pathlib import Path

LONG, MANUAL = 40, 1200
BARS = {"pages": (12, 1.0), "comments": (12, 1.0), "messages": (12, 1.0)}  # median, percent of long ones
AVOID = re.compile(r"\b(hangs? on|stands? off|is said|are said|comes to|whatever the|is none(?! of))\b", re.I)
AVOID_IN_COMMENTS = re.compile(r"\b(hangs? on|stands? off|is said|are said|comes to|comes past|is drawn to|for want of|is not; empty)\b", re.I)


def sentences(text, name=""):
    """Numbers of words; an item of a list begins a sentence. `name`: prints long ones under it."""
    found = []
    for paragraph in re.split(r"\n\s*\n|\n\s*(?:[-*]|\d+\.) ", text):
        for sentence in re.split(r"(?<=[.!?:])\s+", paragraph.replace("\n", " ")):
            words = len(sentence.split())
            if words > 2:
                found.append(words)
            if words > LONG and name:
                print(f"{name}: {words} words: {sentence}")
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


def message_text(text):
    """What users are told: the strings of calls of fail(), NeedsMemory(), note(), say() and warn(), a paragraph for each call."""
    out = []
    for call in re.finditer(r"\b(?:fail|NeedsMemory|DeviceError|note|say|warn)\((.*?)\);", text, flags=re.S):
        joined = re.sub(r'"\s*\n\s*"', "", call.group(1))
        out += re.findall(r'"((?:[^"\\]|\\.)* (?:[^"\\]|\\.)*)"', joined)
    return "\n\n".join(out)


def comment_sentences(text):
    """All sentences of all comments, with the number of the line where their comment begins."""
    blocks, alone = [], False
    for number, line in enumerate(text.split("\n"), 1):
        match = re.search(r"(?:^|\s)//[/]*<? (.*)$", line)
        whole = line.lstrip().startswith("//")
        if match and whole and alone:
            blocks[-1][1].append(match.group(1))
        elif match:
            blocks.append((number, [match.group(1)]))
        alone = whole
    for number, lines in blocks:
        for sentence in re.split(r"(?<=[.!?])\s+", " ".join(lines)):
            yield number, sentence


def bad_starts(root, files):
    """Prints the sentences that begin with a line of language_starts.txt. True if there is one."""
    starts = [line for line in (root / "tests/language_starts.txt").read_text(encoding="utf-8").split("\n") if line and line[0] != "#"]
    pattern = re.compile("(?:" + "|".join(re.escape(s) for s in starts) + r")(?:(?<=,)|\b)")
    bad = False
    for name in files:
        if not name.endswith((".h", ".cpp", ".cu", ".cuh", ".ts")):
            continue
        for line, sentence in comment_sentences((root / name).read_text(encoding="utf-8")):
            if pattern.match(sentence):
                print(f"{name}:{line}: name the subject first: {sentence[:80]}")
                bad = True
    return bad


def row(name, counts, words=None):
    if not counts:
        return
    counts = sorted(counts)
    share = 100 * sum(n > LONG for n in counts) / len(counts)
    print(f"{name:44} {len(counts):6} {counts[len(counts) // 2]:6} {share:8.1f}" + (f" {words:7}" if words else ""))


def has_words_to_avoid(name, text, avoid=AVOID):
    found = list(avoid.finditer(text))
    for at in found:
        print(f"{name}: avoid: ...{text[max(0, at.start() - 30):at.end() + 20]!r}")
    return bool(found)


def tracked_files(root):
    run = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=False)
    return [name for name in run.stdout.split("\n") if name and (root / name).exists()]


def main():
    arguments = [a for a in sys.argv[1:] if not a.startswith("--")]
    root = Path(arguments[0] if arguments else Path(__file__).resolve().parent.parent)
    files, bad = tracked_files(root), False
    if not files:
        print("SKIPPED: no clone of the repository")
        return 0
    print(f"{'':44} {'count':>6} {'median':>6} {'% > 40':>8} {'words':>7}")
    kinds = {"pages": [], "comments": [], "messages": []}
    for name in files:
        told = name if "--long" in sys.argv else ""
        if name.endswith(".md"):
            text = page_text((root / name).read_text(encoding="utf-8"))
            counts, words = sentences(text, told), len(text.split())
            row(name, counts, words)
            kinds["pages"] += counts
            if name.endswith(".1.md") and words > MANUAL:
                print(f"{name}: {words} words, {MANUAL} at most")
                bad = True
            bad |= has_words_to_avoid(name, text)
        elif name.endswith((".h", ".cpp")) and not name.startswith("tests/"):
            text = (root / name).read_text(encoding="utf-8")
            if name.endswith(".h"):
                comments = comment_text(text)
                kinds["comments"] += sentences(comments, told)
                bad |= has_words_to_avoid(name, comments, AVOID_IN_COMMENTS)
            messages = message_text(text)
            kinds["messages"] += sentences(messages, told)
            bad |= has_words_to_avoid(name, messages)
    bad |= bad_starts(root, files)
    for kind, counts in kinds.items():
        row(kind, counts)
        median, share = BARS[kind]
        counts.sort()
        if counts and (counts[len(counts) // 2] > median or 100 * sum(n > LONG for n in counts) / len(counts) > share):
            print(f"{kind}: a median of {median} words and {share} % above {LONG} are the bar")
            bad = True
    row("everything", sum(kinds.values(), []))
    return 1 if bad and "--bar" in sys.argv else 0


if __name__ == "__main__":
    sys.exit(main())
