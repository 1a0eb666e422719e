"""The version of the module is that of the project: CMakeLists.txt names it, and nothing else does."""
import re
from pathlib import Path

from setuptools import setup

root = Path(__file__).resolve().parent.parent.parent
setup(version=re.search(r"^project\(\w+ VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text(encoding="utf-8"), flags=re.M).group(1))
