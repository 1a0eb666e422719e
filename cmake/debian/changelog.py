#!/usr/bin/env python3
"""Prints Debian's form of CHANGELOG.md: its released versions, each with its date.
    cmake/debian/changelog.py CHANGELOG.md VERSION "NAME <ADDRESS>"      VERSION, as 0.3.0-1: of the package; it must be the newest"""
import re
import sys
import textwrap
from datetime import datetime, timezone


def entry(version, date, body, packager):
    """The text of a version: each item of a list is an item; links keep their words."""
    lines = [f"bounding-proxies ({version}) unstable; urgency=medium", ""]
    for item in re.findall(r"^- (.*?)(?=^- |^#|\Z)", body, flags=re.S | re.M):
        plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", " ".join(item.split())).replace("`", "").replace("*", "")
        lines += textwrap.wrap(plain, 78, initial_indent="  * ", subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    when = datetime.strptime(date, "%Y-%m-%d").replace(tzinfo=timezone.utc)
    return "\n".join(lines + ["", f" -- {packager}  {when:%a, %d %b %Y %H:%M:%S +0000}", ""])


def main():
    path, newest, packager = sys.argv[1:]
    with open(path, encoding="utf-8") as file:
        parts = re.split(r"^## (\d+\.\d+\.\d+) \((\d{4}-\d\d-\d\d)\)\n", file.read(), flags=re.M)[1:]
    version, _, revision = newest.partition("-")
    if not parts or parts[0] != version:
        sys.exit(f"{path}: the newest version is {parts[0] if parts else 'missing'}, and the project's is {version}; add a heading: ## {version} (DATE)")
    print("\n".join(entry(f"{v}-{revision if v == version else 1}", date, body, packager) for v, date, body in zip(*[iter(parts)] * 3)), end="")


if __name__ == "__main__":
    sys.exit(main())
