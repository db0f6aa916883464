#!/usr/bin/env python3
"""Checks that the program in README.md is, letter for letter, the example that tests run."""

import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
shown = {"python": "examples/python/first.py"}
blocks = dict(re.findall(r"^```(python)\n(.*?)^```$", (root / "README.md").read_text(encoding="utf-8"), re.M | re.S))
findings = [f"README.md: its {language} block is not {path}" for language, path in shown.items()
            if blocks.get(language) != (root / path).read_text(encoding="utf-8")]
print(*findings, sep="\n", end="\n" if findings else "")
sys.exit(bool(findings))
