#!/usr/bin/env python3
"""Runs clang-tidy over this project's translation units; one that passed is skipped until it changes.

    tools/tidy.py BUILD_FOLDER [FILE…]      BUILD_FOLDER holds compile_commands.json; without FILEs, all of ours

A unit that passed is recorded in BUILD_FOLDER/tidy by a hash of the unit, everything of ours that it includes, its compile
command, its .clang-tidy and the version of clang-tidy. Exits with 1 if anything was found.
"""

import concurrent.futures
import hashlib
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
import sources  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = tuple(folder for folder in sources.FOLDERS if folder not in ("include", "examples", "python"))


def units(build, only):
    """[(path relative to the root, compile command)], the largest first."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = Path(entry["directory"], entry["file"]).resolve()
        if ROOT in path.parents:
            name = path.relative_to(ROOT).as_posix()
            if name.split("/")[0] in FOLDERS and (not only or name in only):
                found[name] = entry.get("command") or " ".join(entry["arguments"])
    return sorted(found.items(), key=lambda unit: -(ROOT / unit[0]).stat().st_size)


def key(path, command, version):
    digest = hashlib.sha256()
    mine = sorted(name for name in sources.reach(ROOT, path) if (ROOT / name).is_file())
    config = next(folder / ".clang-tidy" for folder in (ROOT / path).parents if (folder / ".clang-tidy").is_file())
    for part in [version, command, config.read_text()] + [sources.read(ROOT, name) for name in [path] + mine]:
        digest.update(part.encode() + b"\0")
    return digest.hexdigest()


def run(build, path):
    started = time.monotonic()
    done = subprocess.run(
        ["clang-tidy", "--quiet", "-p", str(build), "--warnings-as-errors=*", "--extra-arg=-Wno-unknown-warning-option",
         "--extra-arg=-Wno-error", str(ROOT / path)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    text = "\n".join(line for line in done.stdout.splitlines() if not re.match(r"\d+ warnings? (generated|treated)|Suppressed", line))
    return done.returncode == 0, text, time.monotonic() - started


def main(arguments):
    if not arguments:
        print(__doc__, file=sys.stderr)
        return 2
    build, only = Path(arguments[0]).resolve(), set(arguments[1:])
    version = subprocess.run(["clang-tidy", "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    passed = build / "tidy"
    passed.mkdir(exist_ok=True)
    keys = {path: key(path, command, version) for path, command in units(build, only)}
    due = [path for path in keys if not (passed / keys[path]).exists()]
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        running = {pool.submit(run, build, path): path for path in due}
        for done in concurrent.futures.as_completed(running):
            path, (good, text, seconds) = running[done], done.result()
            print(f"tidy {path} {'ok' if good else 'FAILED'} ({seconds:.1f} s)", flush=True)
            if good:
                (passed / keys[path]).touch()
            else:
                failed += 1
                print(text, flush=True)
    if not only:
        for stale in set(os.listdir(passed)) - set(keys.values()):
            (passed / stale).unlink()
    print(f"tidy: {len(keys)} translation units, {len(keys) - len(due)} unchanged, {failed} with findings")
    return 1 if failed or not keys else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
