#!/usr/bin/env python3
"""Writes pages of `ursula view` and what `ursula inverse` says of held poses, for view_browser_test.mjs.

usage: view_samples.py URSULA SOURCE OUT
"""
import csv
import io
import json
import math
import re
import subprocess
import sys
from pathlib import Path

ursula, source, out = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
SHIFTS = ((0.03, -0.02, 0.025), (-0.05, 0.04, -0.01))  # m, off the path
TURNS = ((4, -3, 6), (-7, 5, -9))  # degrees: roll, pitch, yaw


def run(*words):
    return subprocess.run([ursula, *map(str, words)], check=True, capture_output=True, text=True).stdout


def rows(scenario, samples):
    return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(io.StringIO(run("inverse", scenario, "--samples", samples)))]


def held(scenario, trajectory):
    text = re.sub(r"^\[trajectory\].*?(?=^\[(?!trajectory)|\Z)", "", scenario.read_text(), flags=re.M | re.S)
    file = scenario.with_suffix(".held.toml")
    file.write_text(text + "\n[trajectory]\nkind = \"hold\"\nduration = 1.0\n" + trajectory)
    row = rows(file, 2)[0]
    file.unlink()
    return row


def quaternion(angles):
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(math.radians(a) / 2), math.sin(math.radians(a) / 2)) for a in angles)
    return [cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy]


def numbers(row, start):
    return [value for name, value in row.items() if name.startswith(start)]


out.mkdir(parents=True, exist_ok=True)
expected = {}
for kind in ("URS", "UPS", "RUS", "PUS"):
    scenario = out / f"{kind}.toml"
    scenario.unlink(missing_ok=True)
    run("init", scenario, "--kind", kind)
    if kind == "UPS":  # a load too
        scenario.write_text(scenario.read_text() + "\n[load]\nframe = \"platform\"\nforce = [100.0, -50.0, 20.0]\nmoment = [5.0, 6.0, -7.0]\npoint = [0.1, 0.0, 0.2]\n")
    run("view", scenario, "--out", out / f"{kind}.html")
    middle = rows(scenario, 3)[1]
    poses = []
    for shift, turn in zip(SHIFTS, TURNS):
        p = [middle[f"p_{axis}_m"] + by for axis, by in zip("xyz", shift)]
        row = held(scenario, f"position = {p}\norientation = {quaternion(turn)}\n")
        poses.append({"sliders": [*p, *turn], "efforts": numbers(row, "tau_")})
    expected[kind] = poses
for name in ("fourbar", "fivebar", "delta"):
    scenario = out / f"{name}.toml"
    shipped = source / "scenarios/mechanisms" / f"{name}.toml"
    scenario.write_text(shipped.read_text().replace(f'"{name}.xml"', f'"{shipped.with_suffix(".xml")}"'))
    run("view", scenario, "--out", out / f"{name}.html")
    start = numbers(rows(scenario, 2)[0], "q_")
    poses = []
    for by in (0.11, -0.07):
        q = [value + by * (1 - 0.3 * k) for k, value in enumerate(start)]
        poses.append({"sliders": [math.degrees(value) for value in q], "efforts": numbers(held(scenario, f"motors = {q}\n"), "tau_")})
    expected[name] = poses
(out / "expected.json").write_text(json.dumps(expected))
