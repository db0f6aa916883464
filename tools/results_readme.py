#!/usr/bin/env python3
"""Writes the measured numbers into results/README.md, between its markers.

    tools/results_readme.py FOLDER README     FOLDER holds summary.json and inverse.csv
"""

import csv
import json
import re
import sys
from pathlib import Path


def checks(summary):
    lines = ["| check | value | limit | unit | verdict |", "| --- | --- | --- | --- | --- |"]
    for check in summary["checks"]:
        value, limit = (f"{x:.2g}" if isinstance(x, (int, float)) else "—" for x in (check["value"], check["limit"]))
        lines.append(f"| `{check['name']}` | {value} | {limit} | {check['unit']} | {check['verdict']} |")
    return [f"Verdict: **{summary['verdict']}**. {summary['reason']}", ""] + lines


def torques(rows):
    lines = ["| t (s) | τ₁ | τ₂ | τ₃ | τ₄ | τ₅ | τ₆ |", "| --- | --- | --- | --- | --- | --- | --- |"]
    for row in (rows[0], rows[len(rows) // 2], rows[-1]):
        cells = [f"{float(row[f'tau_{i}_Nm']):.6f}" for i in range(1, 7)]
        lines.append(f"| {float(row['t_s']):g} | {' | '.join(cells)} |")
    return lines


def main(folder, readme):
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    with open(folder / "inverse.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    text = readme.read_text(encoding="utf-8")
    for name, lines in (("checks", checks(summary)), ("torques", torques(rows))):
        block = f"<!-- {name} -->\n" + "\n".join(lines) + f"\n<!-- /{name} -->"
        text, count = re.subn(f"<!-- {name} -->.*?<!-- /{name} -->", lambda _: block, text, flags=re.S)
        if count != 1:
            sys.exit(f"{readme}: expected the markers of '{name}' once, found them {count} times")
    readme.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), Path(sys.argv[2]))
