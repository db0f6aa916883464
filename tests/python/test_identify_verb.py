"""`ursula identify` as its users call it: a log with noise, the files that it writes, and a log that no right model has."""

import os
import random
import subprocess

import pytest

from conftest import ROOT

PROGRAM = os.environ["URSULA_PROGRAM"]
SCENARIO = ROOT / "scenarios/hexaglide.toml"


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False, timeout=300)


@pytest.fixture(scope="module")
def rows(tmp_path_factory):
    csv = tmp_path_factory.mktemp("inverse") / "inverse.csv"
    assert run("inverse", SCENARIO, "--samples", 1501, "--out", csv).returncode == 0
    return [line.split(",") for line in csv.read_text().splitlines()]


def write_log(path, rows, factor=1.0):
    """Coordinates and efforts with 1 N of noise; those of motor 3 are multiplied."""
    names = ["t_s", *(f"d_{k}_m" for k in range(1, 7)), *(f"tau_{k}_N" for k in range(1, 7))]
    columns = [rows[0].index(name) for name in names]
    dice = random.Random(1)
    with open(path, "w", encoding="utf-8") as log:
        print(*names, sep=",", file=log)
        for row in rows[1:]:
            values = [float(row[k]) for k in columns]
            values[9] *= factor
            print(*values[:7], *(value + dice.gauss(0, 1) for value in values[7:]), sep=",", file=log)
    return path


def test_a_right_model_passes_and_its_files_are_there(rows, tmp_path):
    done = run("identify", SCENARIO, "--measured", write_log(tmp_path / "log.csv", rows), "--out", tmp_path / "out")
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.startswith("pass: ")
    written = {each.name: each.stat().st_size for each in (tmp_path / "out").iterdir()}
    for name in ("report.html", "summary.json", "identified.toml", "parameters.csv", "efforts.csv", "spectra.csv"):
        assert written.get(name, 0) > 100, name
    assert run("check", tmp_path / "out" / "identified.toml").returncode == 0


def test_a_scaled_effort_fails_and_is_named(rows, tmp_path):
    log = write_log(tmp_path / "log.csv", rows, factor=1.1)
    done = run("identify", SCENARIO, "--measured", log, "--out", tmp_path / "out")
    assert done.returncode == 1, done.stdout + done.stderr
    assert done.stdout.startswith("fail: ") and "motor 3" in done.stdout


def test_a_log_without_efforts_is_refused_with_its_place(rows, tmp_path):
    log = tmp_path / "log.csv"
    log.write_text("\n".join(",".join(row[:7]) for row in rows) + "\n", encoding="utf-8")
    done = run("identify", SCENARIO, "--measured", log, "--out", tmp_path / "out")
    assert done.returncode == 2
    assert "log.csv" in done.stderr and "error" in done.stderr
    assert not (tmp_path / "out").exists()
