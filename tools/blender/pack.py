#!/usr/bin/env python3
"""Packs the add-on for Blender's "Install from Disk": 3.4 and later as an add-on, 4.2 and later as an extension.
    tools/blender/pack.py ZIP
The same bytes on every machine."""
import sys
import zipfile
from pathlib import Path

NAME = "bounding_proxies_addon"


def main() -> None:
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    folder = Path(__file__).resolve().parent
    files = sorted(path for path in (folder / NAME).iterdir() if path.suffix in (".py", ".toml"))
    with zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED) as out:
        for path in files + [folder.parent.parent / "LICENSE"]:
            entry = zipfile.ZipInfo(f"{NAME}/{path.name}", (1980, 1, 1, 0, 0, 0))
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            out.writestr(entry, path.read_bytes())
    print(f"{sys.argv[1]}: {len(files)} files")


if __name__ == "__main__":
    main()
