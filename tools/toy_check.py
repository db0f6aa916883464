#!/usr/bin/env python3
"""Shows what a check costs: adds a toy to a copy of the tree, in five files, and looks for it wherever checks are seen.

    tools/toy_check.py add TREE        adds `motion.toy` to a copy of the tree, which is then built as ever
    tools/toy_check.py look PROGRAM    looks for it in a result, in `explain` and in the documents of that build

`look` exits with 0, or with 1 after a line for each place that lacks it: so does a build without the toy.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
NAME, PROVES = "motion.toy", "The motion takes some time."

HEADER = """#pragma once

#include "validation/evidence/evidence.h"
#include "validation/verdict/result.h"

namespace ursula {

std::vector<Check> judgeToy(const Evidence& evidence);

}  // namespace ursula
"""
SOURCE = f"""#include "validation/checks/toy_check.h"

namespace ursula {{

std::vector<Check> judgeToy(const Evidence& evidence) {{
  Check check;
  check.name = "{NAME}";
  check.unit = "s";
  check.value = -evidence.given->trajectory->duration();
  check.limit = 0;
  check.basis = "a duration is positive";
  check.verdict = check.value <= check.limit ? Verdict::pass : Verdict::fail;
  return {{check}};
}}

}}  // namespace ursula
"""
ROW = f"""      {{"{NAME}", "s", N::nothing, G::input, StandsOn::itself, "Toy", "Time passes.", "{PROVES}", "", LimitFrom::exact,
       "A duration is positive.", "Give the motion a duration."}},
"""
FAMILY = f"""      {{"toy", {{"{NAME}"}}, always, judgeToy, nullptr, true}},
"""
NEW = {"validation/checks/toy_check.h": HEADER, "validation/checks/toy_check.cpp": SOURCE}
# file: [(the line before which, what is put)]
EDITS = {
    "validation/checks/CMakeLists.txt": [("    torque_between.cpp\n", "    toy_check.cpp\n")],
    "model/check_rows_input.cpp": [('      {"motion.load"', ROW)],
    "validation/checks/families.cpp": [
        ('#include "validation/checks/torque_between.h"', '#include "validation/checks/toy_check.h"\n'),
        ('      {"between samples"', FAMILY)],
}


def add(tree):
    for path, text in NEW.items():
        (tree / path).write_text(text, encoding="utf-8")
    for path, edits in EDITS.items():
        text = (tree / path).read_text(encoding="utf-8")
        for before, put in edits:
            if text.count(before) != 1:
                sys.exit(f"{path}: expected one {before!r}")
            text = text.replace(before, put + before)
        (tree / path).write_text(text, encoding="utf-8")
    print(f"{NAME}: {len(NEW) + len(EDITS)} files")


def look(program):
    """The places that lack the check."""
    def output(*arguments):
        return subprocess.run([program, *arguments], capture_output=True, text=True, check=False).stdout

    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        output("validate", str(ROOT / "scenarios/paper-helix.toml"), "--out", str(folder / "result"))
        output("docs", str(folder))
        summary = next((folder / "result").rglob("summary.json"), None)
        checks = json.loads(summary.read_text(encoding="utf-8"))["checks"] if summary else []
        page = folder / "checks.md"
        seen = {
            "the result": any(check["name"] == NAME and check["verdict"] == "pass" for check in checks),
            "explain": PROVES in output("explain", NAME) and NAME in output("explain"),
            "the documents": page.is_file() and f"| `{NAME}` | {PROVES}" in page.read_text(encoding="utf-8"),
            "the completions": NAME in output("docs", "--completion", "bash"),
        }
    return [place for place, there in seen.items() if not there]


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("add", "look"):
        sys.exit(__doc__)
    if sys.argv[1] == "add":
        tree = Path(sys.argv[2]).resolve()
        if tree == ROOT:
            sys.exit("the tree that this is a part of stays as it is: give a copy")
        return add(tree)
    lacking = look(str(Path(sys.argv[2]).resolve()))
    for place in lacking:
        print(f"{place}: no {NAME}")
    return int(bool(lacking))


if __name__ == "__main__":
    sys.exit(main())
