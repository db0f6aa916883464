#!/usr/bin/env python3
"""Shows which files each frequent addition touches: adds a toy of each to a copy of the tree, and looks for them.

    tools/toys.py add TREE        adds all toys to a copy of the tree, which is then built as ever
    tools/toys.py look PROGRAM    looks for each of them in what that build says and does
    tools/toys.py count           counts the files of each, and says which of their places the tree lacks

`look` exits with 0, or with 1 after a line for each place that lacks a toy: so does a build without them.
CONTRIBUTING.md has the steps in words. `./dev toys` does all of this.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
from toy_sources import TOYS  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent


def changed(name, tree):
    """The files of a toy with their texts, and the places that the tree lacks."""
    texts, lacking = dict(TOYS[name].new), []
    for path, edits in TOYS[name].edits.items():
        text = (tree / path).read_text(encoding="utf-8")
        for before, put in edits:
            if text.count(before) != 1:
                lacking.append(f"{name}: {path}: expected one {before!r}, found {text.count(before)}")
            text = text.replace(before, put + before)
        texts[path] = text
    return texts, lacking


def add(tree, write=True):
    lacking = []
    for name, toy in TOYS.items():
        texts, places = changed(name, tree)
        lacking += places
        for path, text in texts.items() if write else ():
            (tree / path).parent.mkdir(parents=True, exist_ok=True)
            (tree / path).write_text(text, encoding="utf-8")
        print(f"{name}: {len(texts)} files, {len(toy.new)} of them new")
    for place in lacking:
        print(place, file=sys.stderr)
    return int(bool(lacking))


class Program:
    """The program under test, with a folder of its own to write in."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def run(self, *arguments):
        done = subprocess.run([self.program, *arguments], capture_output=True, text=True, check=False, cwd=self.folder)
        return done.returncode, done.stdout + done.stderr

    def text(self, *arguments):
        return self.run(*arguments)[1]

    def written(self, name):
        path = self.folder / name
        return path.read_text(encoding="utf-8") if path.is_file() else ""

    def scenario(self, name, old="", new=""):
        """Writes a shipped scenario with one change; returns its name."""
        text = (ROOT / "scenarios/paper-helix.toml").read_text(encoding="utf-8")
        (self.folder / name).write_text(text.replace(old, new, 1) if old else text, encoding="utf-8")
        return name


def look_for_check(program):
    program.run("validate", program.scenario("check.toml"), "--out", "result")
    summary = next((program.folder / "result").rglob("summary.json"), None)
    checks = json.loads(summary.read_text(encoding="utf-8"))["checks"] if summary else []
    return {"the result": any(check["name"] == "motion.toy" and check["verdict"] == "pass" for check in checks),
            "explain": "motion.toy" in program.text("explain"),
            "the documents": "| `motion.toy` |" in program.written("docs/checks.md"),
            "the completions": "motion.toy" in program.text("docs", "--completion", "bash")}


def look_for_trajectory(program):
    motion = '[trajectory]\nkind = "toy"\nposition = [0, 0, 1]\nduration = 1\n'
    text = program.text("init", "toy.toml", "--kind", "UPS") and program.written("toy.toml")
    start = text.index("[trajectory]")
    (program.folder / "toy.toml").write_text(text[:start] + motion, encoding="utf-8")
    return {"check": program.run("check", "toy.toml")[0] == 0, "validate": program.run("validate", "toy.toml")[0] == 0,
            "the documents": 'kind = "toy"' in program.written("docs/scenario.md")}


def look_for_engine(program):
    code, text = program.run("engines", program.scenario("engine.toml"), "--out", "engines")
    return {"the terminal": code == 0 and "Toy" in text, "the page": "Toy" in program.written("engines/report.html")}


def look_for_leg_kind(program):
    program.run("init", "legs.toml", "--kind", "TOY")
    return {"init": 'kind = "TOY"' in program.written("legs.toml"), "check": program.run("check", "legs.toml")[0] == 0,
            "validate": program.run("validate", "legs.toml")[0] == 0}


def look_for_verb(program):
    return {"the verb": program.run("toy") == (0, "a toy\n"), "the help": "\n  toy " in program.text("--help"),
            "the man page": "toy" in program.text("docs", "--man")}


def look_for_key(program):
    def check(value):
        return program.run("check", program.scenario("key.toml", "[trajectory]", f"[simulation]\ntoy = {value}\n[trajectory]"))

    return {"a right value": check("2")[0] == 0, "a refusal": check("-1")[0] == 2 and "simulation.toy" in check("-1")[1],
            "the documents": "`toy`" in program.written("docs/scenario.md")}


LOOKS = {"check": look_for_check, "trajectory": look_for_trajectory, "engine": look_for_engine,
         "kind of leg": look_for_leg_kind, "verb": look_for_verb, "key": look_for_key}


def look(path):
    """The places that lack a toy."""
    lacking = []
    with tempfile.TemporaryDirectory() as folder:
        program = Program(path, Path(folder))
        program.run("docs", "docs")
        for name, find in LOOKS.items():
            lacking += [f"{name}: not in {place}" for place, there in find(program).items() if not there]
    return lacking


def main():
    if sys.argv[1:] == ["count"]:
        return add(ROOT, write=False)
    if len(sys.argv) != 3 or sys.argv[1] not in ("add", "look"):
        sys.exit(__doc__)
    if sys.argv[1] == "add":
        tree = Path(sys.argv[2]).resolve()
        if tree == ROOT:
            sys.exit("the tree that this is a part of stays as it is: give a copy")
        return add(tree)
    assert set(LOOKS) == set(TOYS)
    lacking = look(str(Path(sys.argv[2]).resolve()))
    for place in lacking:
        print(place)
    return int(bool(lacking))


if __name__ == "__main__":
    sys.exit(main())
