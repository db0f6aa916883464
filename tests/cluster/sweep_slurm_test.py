#!/usr/bin/env python3
"""`ursula sweep --slurm` on a real Slurm: an array of four of which one is killed and three lose their node, a merge that
finds one missing, its resubmission; then the rows are those of one process.

    sweep_slurm_test.py PROGRAM SCENARIO

Exits with 77 where no Slurm can be started here.
"""

import contextlib
import json
import math
import os
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
from slurm_cluster import Cluster, NoCluster, wait_until  # noqa: E402

SHARDS = 4
KILLED, OTHERS = 2, (1, 3, 4)
SECONDS_A_TASK = 4  # of work, so that a signal or limit meets a working task
LEAST_POINTS = 60  # of a task
SWEEP = """\
scenario = {scenario}
what = "validate"
design = "random"
count = {count}

[[vary]]
key = "manipulator.platform.mass"
uniform = [400.0, 600.0]

[[vary]]
key = "platform.center_of_mass.*"
plus_minus = 0.1

[slurm]
partition = "main"
options = ["--comment=two words"]
"""
TABLES = {"point": ("id, parameters, verdict, error", "id"), "result": ('point, name, value, "limit", verdict', "point, name")}


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def rows(database, query):
    with contextlib.closing(sqlite3.connect(f"{database.as_uri()}?mode=ro", uri=True)) as opened:
        return opened.execute(query).fetchall()


def content(database):
    return {table: rows(database, f"SELECT {columns} FROM {table} ORDER BY {order}")
            for table, (columns, order) in TABLES.items()}


def points_in(database):
    """None yet while it is being made."""
    try:
        return rows(database, "SELECT count(*) FROM point")[0][0]
    except sqlite3.OperationalError:
        return 0


class Sweep:
    def __init__(self, program, scenario, folder, cluster):
        self.program, self.scenario, self.folder, self.cluster = program, scenario, folder, cluster
        self.file, self.database = folder / "mass.toml", folder / "results" / "mass.db"

    def write(self, file, count):
        file.write_text(SWEEP.format(scenario=json.dumps(str(self.scenario)), count=count))

    def start(self, *arguments):
        return subprocess.Popen([self.program, "sweep", *arguments], cwd=self.folder, env=self.cluster.environment,
                                text=True, stdout=subprocess.PIPE)

    def run(self, *arguments):
        process = self.start(*arguments)
        out = process.communicate()[0]
        return process.returncode, out

    def submit(self):
        code, out = self.run(self.file.name, "--pointwise", "--slurm", "--shards", str(SHARDS))
        print(out, end="", flush=True)
        check(code == 0, f"--slurm ended with {code}")
        return out

    def shard(self, index):
        return self.folder / "results" / f"mass.shard-{index}-of-{SHARDS}.db"

    def log(self, name):
        return (self.folder / "results" / "mass.slurm" / "logs" / name).read_text()

    def make(self):
        """As many points as keep tasks at work for some seconds, here."""
        probe = self.folder / "probe.toml"
        self.write(probe, 8)
        self.run(probe.name, "--pointwise", "--jobs", "1")
        mean = rows(self.folder / "results" / "probe.db", "SELECT avg(seconds) FROM point")[0][0]
        self.points = SHARDS * max(LEAST_POINTS, math.ceil(SECONDS_A_TASK / mean))
        self.write(self.file, self.points)
        print(f"{self.points} points, {mean:.2g} s each", flush=True)


def job_in(out, what):
    found = re.search(what + r".*: job (\d+)$", out, re.M)
    check(found, f"no job in: {out}")
    return int(found[1])


def states(cluster, array):
    return {k: cluster.job(f"{array}_{k}")["JobState"] for k in range(1, SHARDS + 1)}


def kill_one(sweep, cluster, array):
    check(states(cluster, array)[KILLED] == "RUNNING", "the task to be killed does not run")
    cluster.call("scancel", f"{array}_{KILLED}")
    wait_until("the task is killed", lambda: states(cluster, array)[KILLED] == "CANCELLED")
    log = f"{array}_{KILLED}.log"
    wait_until("it says so", lambda: "stopped:" in sweep.log(log))
    left = points_in(sweep.shard(KILLED))
    check(0 < left < sweep.points // SHARDS, f"the killed task has {left} points: it was not at work")
    print(f"killed task {KILLED} at {left} of {sweep.points // SHARDS} points", flush=True)


def lose_the_node(sweep, cluster, array):
    """Gives the reference meanwhile, as the machine has nothing to do."""
    check(all(states(cluster, array)[k] == "RUNNING" for k in OTHERS), "a task that is to lose its node does not run")
    check(cluster.fail_node() >= len(OTHERS), "the node had no tasks to lose")
    after = states(cluster, array)
    check(all(after[k] == "PENDING" for k in OTHERS), f"the node is down, and tasks are {after}")
    for k in OTHERS:
        left = points_in(sweep.shard(k))
        check(0 < left < sweep.points // SHARDS, f"task {k} has {left} points: it was not at work")
        print(f"task {k} lost its node at {left} of {sweep.points // SHARDS} points", flush=True)
    one = sweep.start(sweep.file.name, "--pointwise", "--db", "one.db")
    cluster.start_node()
    return one


def array_with_losses(sweep, cluster):
    out = sweep.submit()
    array, merge = job_in(out, "4 of 4 shards submitted"), job_in(out, "merge into")
    check(cluster.job(merge)["JobState"] == "PENDING", "the merge does not wait")
    wait_until("each task has points", lambda: all(points_in(sweep.shard(k)) > 0 for k in range(1, SHARDS + 1)))
    jobs = cluster.call("squeue", "--array", "--noheader", "--format=%i")
    out = sweep.submit()
    check("4 of 4 shards are already in the queue" in out and "submitted (" not in out, "running shards were submitted twice")
    check(cluster.call("squeue", "--array", "--noheader", "--format=%i") == jobs, "there are more jobs than before")
    kill_one(sweep, cluster, array)
    one = lose_the_node(sweep, cluster, array)
    wait_until("the array has ended", lambda: all(states(cluster, array)[k] == "COMPLETED" for k in OTHERS))
    for k in OTHERS:
        job = cluster.job(f"{array}_{k}")
        check(job["Restarts"] == "1" and points_in(sweep.shard(k)) == sweep.points // SHARDS, f"task {k}: {job}")
    wait_until("the merge has ended", lambda: cluster.job(merge)["JobState"] == "FAILED")
    check(cluster.job(merge)["ExitCode"] == "3:0", "the merge does not say that points are missing")
    check(f"--shard {KILLED}/{SHARDS}" in sweep.log(f"merge-{merge}.log"), "the merge does not say which shard is missing")
    return one


def resubmission(sweep, cluster):
    out = sweep.submit()
    again, merge = job_in(out, r"1 of 4 shards submitted \(2\)"), job_in(out, "merge into")
    wait_until("the merge has ended", lambda: cluster.job(merge)["JobState"] in ("COMPLETED", "FAILED"))
    check(cluster.job(f"{again}_{KILLED}")["JobState"] == "COMPLETED", "the shard was not made")
    check(cluster.job(merge)["JobState"] == "COMPLETED", sweep.log(f"merge-{merge}.log"))


def compare(sweep, one):
    out = one.communicate()[0]
    check(one.returncode in (0, 1, 3), f"one process: {one.returncode}, {out}")
    merged, alone = content(sweep.database), content(sweep.folder / "one.db")
    check(len(alone["point"]) == sweep.points and len(alone["result"]) >= sweep.points, "one process made too few rows")
    check(merged == alone, "the merged database is not that of one process")
    for change in ("UPDATE result SET value = value * (1 + 1e-15) WHERE point = 7 AND value != 0",
                   "DELETE FROM point WHERE id = 3"):
        copy = sweep.folder / "changed.db"
        shutil.copyfile(sweep.database, copy)
        with contextlib.closing(sqlite3.connect(copy)) as opened:
            opened.execute(change)
            opened.commit()
        check(content(copy) != alone, f"a database after '{change}' passes for the same")
    print(f"equal: {len(merged['point'])} rows of point, {len(merged['result'])} of result", flush=True)


def main(program, scenario):
    began = time.monotonic()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that started processes are stopped
    folder = Path(tempfile.mkdtemp(prefix="ursula it's 100% \"$HOME\" & # "))
    try:
        with Cluster(cpus=SHARDS) as cluster:
            sweep = Sweep(program, scenario, folder, cluster)
            sweep.make()
            one = array_with_losses(sweep, cluster)
            resubmission(sweep, cluster)
            compare(sweep, one)
            check("nothing to do" in sweep.submit(), "a whole sweep is submitted again")
    except NoCluster as reason:
        print(f"SKIPPED: sweep --slurm was NOT tested on a real Slurm: {reason}")
        return 77
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    print(f"passed in {time.monotonic() - began:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])))
