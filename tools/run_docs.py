#!/usr/bin/env python3
"""Runs the examples of a page of docs/, in order, in a folder of their own: run_docs.py PROGRAM PAGE… [--module FOLDER] [--long].

    ```console   commands after `$ `, then the lines of their output that matter, in order. `…` stands for any text, and
                 white space does not count. Numbers are compared to the digits shown, give or take one of the last; below 1e-6 both must be.
                 A command must succeed; one that must fail is followed by `|| echo "exit code $?"`.
    ```console long    the same, if it takes a minute: it is left out without --long.
    ```python    a program, run by itself; a ```text block after it is its output.
    ```cpp       stands letter for letter in a file of examples/, which other tests build and run.
    ```sh        commands that a test cannot run: the build, packages, containers, but nothing of `ursula`.

A block of any language whose first line is a comment with a file's name, `# mine.py`, is written to that file instead.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"^```(\S*)( long)?[^\n]*\n(.*?)^```$", re.M | re.S)
NAMED = re.compile(r"(?:#|//|%) ([\w-]+\.\w+)$")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.]*\d)")
NOT_RUN = ("./dev ", "cmake ", "git ", "apt", "sudo ", "docker ", "podman ", "#", "cd ")
SMALL = 1e-6
SECONDS = 600


class Wrong(Exception):
    pass


def blocks(text, long=True):
    return [(match[1], match[3], text.count("\n", 0, match.start()) + 1) for match in BLOCK.finditer(text) if long or not match[2]]


def same_number(shown, found):
    a, b = float(shown), float(found)
    if "e" not in shown.lower() and "." not in shown:
        return a == b
    if 0 < abs(a) < SMALL:
        return abs(b) < SMALL
    digits = shown.lower().split("e")[0]
    last = 10.0 ** -len(digits.partition(".")[2]) * (10.0 ** int(shown.lower().split("e")[1]) if "e" in shown.lower() else 1)
    return abs(a - b) <= 1.01 * last


def matches(shown, found):
    """Whether a line of output agrees with the line on the page."""
    pattern, numbers = "", []
    for part in re.split(r"(…|\s+)", shown.strip()):
        if part == "…":
            pattern += ".*?"
        elif part.isspace():
            pattern += r"\s+"
        else:
            at = 0
            for number in NUMBER.finditer(part):
                pattern += re.escape(part[at:number.start()]) + r"([-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)"
                numbers.append(number[0])
                at = number.end()
            pattern += re.escape(part[at:])
    match = re.fullmatch(r"\s*" + pattern.strip() + r"\s*", found)
    return bool(match) and all(map(same_number, numbers, match.groups()))


def compare(expected, output):
    lines = output.splitlines()
    at = 0
    for shown in filter(str.strip, expected):
        if shown.strip() == "…":
            continue
        at = next((k + 1 for k in range(at, len(lines)) if matches(shown, lines[k])), None)
        if at is None:
            raise Wrong(f"expected the line\n    {shown}\nafter the ones before it in the output\n    " + "\n    ".join(lines[-40:]))


def commands(body):
    """[(command, lines of output)] of a console block."""
    found = []
    lines = iter(body.splitlines())
    for line in lines:
        if line.startswith("$ "):
            command = line[2:]
            while command.endswith("\\"):
                command += "\n" + next(lines)
            found.append((command, []))
        elif found:
            found[-1][1].append(line)
        elif line.strip():
            raise Wrong(f"output before a command: {line}")
    return found


class Runner:
    def __init__(self, folder, program, module):
        self.folder, binaries = folder, folder / ".bin"
        binaries.mkdir()
        (binaries / "ursula").symlink_to(program)
        (binaries / "python3").symlink_to(sys.executable)
        for name in ("scenarios", "sweeps", "examples"):
            (folder / name).symlink_to(ROOT / name)
        self.environment = {**os.environ, "PATH": f"{binaries}:{os.environ['PATH']}", "PYTHONPATH": str(module or ""),
                            "PYTHONDONTWRITEBYTECODE": "1", "NO_COLOR": "1", "LC_ALL": "C.UTF-8"}

    def run(self, command, shell=True):
        done = subprocess.run(["bash", "-o", "pipefail", "-c", command] if shell else command, cwd=self.folder, env=self.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, timeout=SECONDS)
        if done.returncode:
            raise Wrong(f"exit code {done.returncode} of\n    {command}\n{done.stdout[-3000:]}")
        return done.stdout

    def block(self, language, body, expected):
        """`expected`: the text block after it, of a Python program."""
        named = NAMED.match(body.partition("\n")[0].strip())
        if named and language not in ("console", "text"):
            (self.folder / named[1]).write_text(body, encoding="utf-8")
        elif language == "console":
            for command, lines in commands(body):
                compare(lines, self.run(command))
        elif language == "python":
            compare((expected or "").splitlines(), self.run([str(self.folder / ".bin/python3"), "-c", body], shell=False))
        elif language == "cpp":
            if not any(body in path.read_text(encoding="utf-8") for path in (ROOT / "examples").glob("*.cpp")):
                raise Wrong("no file of examples/ has this block letter for letter")
        elif language == "sh":
            strange = [line for line in body.splitlines() if line.strip() and not line.startswith(NOT_RUN)]
            if strange:
                raise Wrong(f"a command that a test can run belongs into a console block: {strange[0]}")
        elif not language and re.search(r"^(\$ )?(\./)?ursula ", body, re.M):
            raise Wrong("a block without a language has a command, expected a console block")


def run_page(page, program, module, long=False):
    """The number of blocks that were run; raises Wrong with the place."""
    found = blocks(page.read_text(encoding="utf-8"), long)
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner(Path(folder), program, module)
        for k, (language, body, line) in enumerate(found):
            following = found[k + 1] if k + 1 < len(found) else ("", "", 0)
            try:
                runner.block(language, body, following[1] if following[0] == "text" else None)
            except (Wrong, subprocess.TimeoutExpired) as error:
                raise Wrong(f"{page}:{line}: {error}") from None
    return sum(language in ("console", "python") for language, _, _ in found)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("pages", type=Path, nargs="+")
    parser.add_argument("--module", type=Path)
    parser.add_argument("--long", action="store_true")
    given = parser.parse_args()
    failed = False
    for page in given.pages:
        try:
            count = run_page(page, given.program.resolve(), given.module and given.module.resolve(), given.long)
            print(f"{page}: {count} blocks run")
        except Wrong as error:
            print(error, file=sys.stderr)
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
