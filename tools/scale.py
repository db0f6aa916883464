#!/usr/bin/env python3
"""Measures the cost of sweeps on this machine, and computes and merges 1,000 shards of one.

    tools/scale.py URSULA FOLDER [--shards N]     writes FOLDER/README.md

It takes a few minutes; nothing else should run on the machine.
"""

import argparse
import os
import resource
import sqlite3
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from performance import processor

SCENARIOS = Path(__file__).resolve().parent.parent / "scenarios"
HEAD = """scenario = "{scenario}"
what = "{what}"
pointwise = {pointwise}
design = "random"
count = {count}
samples = 101

[[vary]]
key = "manipulator.platform.mass"
uniform = [400.0, 600.0]

[[vary]]
key = "manipulator.platform.center_of_mass.*"
plus_minus = 0.1
"""


def sweep_file(folder, name, what, count, pointwise=False):
    path = folder / f"{name}.toml"
    path.write_text(HEAD.format(scenario=SCENARIOS / "paper-helix.toml", what=what, count=count,
                                pointwise=str(pointwise).lower()), encoding="utf-8")
    return path


def timed(*call):
    """The seconds of a command, and the largest memory of it and its workers so far, MB."""
    start = time.monotonic()
    subprocess.run([str(part) for part in call], check=True, capture_output=True)
    return time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024


def costs(ursula, folder):
    rows = []
    for name, what, count, pointwise in (("inverse", "inverse", 10000, False), ("validate, pointwise", "validate", 300, True),
                                         ("validate", "validate", 8, False)):
        path, database = sweep_file(folder, "cost", what, count, pointwise), folder / "cost.db"
        repeats = []
        for _ in range(3):
            database.unlink(missing_ok=True)
            repeats.append(timed(ursula, "sweep", path, "--db", database, "--jobs", 1)[0])
        seconds = statistics.median(repeats)
        with sqlite3.connect(database) as connection:
            done = connection.execute("SELECT count(*) FROM point").fetchone()[0]
        assert done == count
        rows.append((name, count / seconds, 1e3 * seconds / count, database.stat().st_size / count))
        database.unlink()
    return rows


def memory(ursula, folder):
    rows = []
    for count in (1000, 100000):
        database = folder / "memory.db"
        rows.append((count, timed(ursula, "sweep", sweep_file(folder, "memory", "inverse", count), "--db", database)[1]))
        database.unlink()
    return rows


def shards(ursula, folder, count):
    """Runs one process for each shard, as a cluster does, and one merge."""
    path = sweep_file(folder, "shards", "inverse", 100 * count)
    parts = [folder / f"part-{k}.db" for k in range(1, count + 1)]
    start = time.monotonic()
    for k, part in enumerate(parts, 1):
        timed(ursula, "sweep", path, "--shard", f"{k}/{count}", "--db", part, "--jobs", 1)
    made = time.monotonic() - start
    whole, merged = folder / "whole.db", folder / "merged.db"
    alone, _ = timed(ursula, "sweep", path, "--db", whole, "--jobs", 1)
    merging, _ = timed(ursula, "sweep", "merge", *parts, "--db", merged)
    again, _ = timed(ursula, "sweep", "merge", *parts, "--db", merged)
    rows = []
    for database in (whole, merged):
        with sqlite3.connect(database) as connection:
            rows.append((connection.execute("SELECT id, parameters, verdict, error FROM point").fetchall(),
                         connection.execute("SELECT * FROM result").fetchall()))
    assert rows[0] == rows[1] and len(rows[0][0]) == 100 * count, "the merged database is not that of one process"
    return {"shards": count, "points": 100 * count, "made": made, "alone": alone, "merge": merging, "again": again,
            "start": (made - alone) / count, "rows": len(rows[0][1])}


def readme(cost, used, run, ursula):
    version = subprocess.run([ursula, "--version"], check=True, capture_output=True, text=True).stdout.strip()
    lines = ["# What sweeps cost", "",
             f"Measured by `./dev results scale` with ursula {version} on {processor()}, {os.cpu_count()} hardware threads, one process at a time; "
             "medians of three. The paper's helix, 101 instants, four numbers vary.", "",
             "| what | points a second and process | ms a point | bytes a point in the database |", "| --- | --- | --- | --- |"]
    lines += [f"| {name} | {rate:.3g} | {ms:.3g} | {size:.0f} |" for name, rate, ms, size in cost]
    lines += ["", "| points | largest process, MB |", "| --- | --- |"]
    lines += [f"| {count} | {mb:.0f} |" for count, mb in used]
    lines += ["", f"{run['shards']} shards, {run['points']} points of `inverse`, {run['rows']} rows of results, one process after the other:", "",
              "| step | s |", "| --- | --- |",
              f"| all shards | {run['made']:.1f} |", f"| the same points by one process | {run['alone']:.1f} |",
              f"| so one more shard costs | {run['start']:.3f} |",
              f"| merge: {run['points'] / run['merge']:.0f} points a second | {run['merge']:.2f} |",
              f"| the same merge again, which changes nothing | {run['again']:.2f} |", "",
              "The merged database equals that of one process, row for row."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("ursula")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--shards", type=int, default=1000)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        text = readme(costs(options.ursula, folder), memory(options.ursula, folder),
                      shards(options.ursula, folder, options.shards), options.ursula)
    options.folder.mkdir(parents=True, exist_ok=True)
    (options.folder / "README.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    sys.exit(main())
