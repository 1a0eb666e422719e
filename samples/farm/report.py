#!/usr/bin/env python3
"""Writes OUT/report.html: what became of each scene in a night, with pictures.
  report.py OUT    after samples/nightly --report: reads OUT/report.tsv, that of the night before, and the times of the jobs"""
import csv
import glob
import html
import os
import subprocess
import sys
from urllib.parse import quote

STYLE = ("body{font:15px sans-serif;max-width:60em;margin:2em auto}td,th{padding:.3em 1em .3em 0;text-align:left;vertical-align:top}"
         ".failed{color:#b00}img{max-width:15em}")
HEAD = ["scene", "picture", "what happened", "levels", "faces", "bytes", "jobs", "seconds of work"]


def table(path):
    if not os.path.exists(path):
        return {}
    with open(path, newline="") as file:
        return {row["scene"]: row for row in csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE)}


def times(out, scene):
    """How many jobs, and their seconds in words, by what they do."""
    jobs, seconds = 0, {"tiles": 0, "levels": 0, "check": 0}
    for path in glob.glob(os.path.join(glob.escape(os.path.join(out, ".farm", quote(scene, safe=""))), "*.time")):
        kind = os.path.basename(path).split("-")[0].split(".")[0]
        with open(path) as file:
            for row in csv.DictReader(file, delimiter="\t"):
                jobs += 1
                seconds[kind if kind in seconds else "tiles"] += float(row["s"])
    each = ", ".join(f"{kind} {round(s)}" for kind, s in seconds.items()) if seconds["tiles"] else ""
    return jobs, f"{round(sum(seconds.values()))}" + (f" ({each})" if each else "")


def picture(out, scene):
    """Of the finest level; kept while the levels are."""
    folder = os.path.join(out, scene)
    files = sorted(glob.glob(os.path.join(glob.escape(folder), "tileset.json")) or
                   glob.glob(os.path.join(glob.escape(folder), "*.glb")))
    if not files or not os.path.exists(os.path.join(folder, ".key")):  # not made here
        return ""
    image = os.path.join(folder, "picture.png")
    if not os.path.exists(image):
        subprocess.run(["bpinfo", files[0], "--image", image, "--image-size", "480"], stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
    return f'<img src="{quote(scene)}/picture.png" alt="">' if os.path.exists(image) else ""


def number(now, before):
    """With what changed since the night before."""
    change = int(now) - int(before or 0)
    return f"{int(now):,}" + (f" ({change:+,})" if before and change else "")


def line(out, row, before):
    scene, status = row["scene"], row["status"]
    jobs, seconds = times(out, scene)
    cells = [html.escape(scene), picture(out, scene), html.escape(status)]
    cells += [number(row[what], before.get(what)) for what in ("levels", "faces", "bytes")] + [str(jobs), seconds]
    kind = ' class="failed"' if status.startswith("failed") else ""
    return f"<tr{kind}>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def main():
    out = sys.argv[1]
    now, before = table(os.path.join(out, "report.tsv")), table(os.path.join(out, ".farm", "last.tsv"))
    rows = sorted(now.values(), key=lambda row: not row["status"].startswith("failed"))
    count = {word: sum(row["status"].startswith(word) for row in rows) for word in ("made", "same", "failed", "gone")}
    text = ['<!DOCTYPE html><meta charset="utf-8"><title>The night</title>', f"<style>{STYLE}</style><h1>The night</h1>",
            "<p>" + ", ".join(f"{n} {word}" for word, n in count.items()) + "</p>",
            "<table><tr>" + "".join(f"<th>{word}</th>" for word in HEAD) + "</tr>"]
    text += [line(out, row, before.get(row["scene"], {})) for row in rows]
    with open(os.path.join(out, "report.html"), "w") as file:
        file.write("\n".join(text) + "\n</table>\n")


main()
