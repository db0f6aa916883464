"""The drawings of the legs: their geometry is the program's, and each is well-formed."""

import csv
import os
import subprocess
import sys
import tomllib
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
import site_legs  # noqa: E402


@pytest.mark.parametrize("kind", site_legs.LEGS)
def test_coordinates_are_the_programs(kind, tmp_path):
    def program(*arguments):
        return subprocess.run([os.environ["URSULA_PROGRAM"], *arguments], cwd=tmp_path, capture_output=True, text=True, check=True).stdout

    program("init", "my.toml", "--kind", kind)
    machine = tomllib.loads((tmp_path / "my.toml").read_text())["manipulator"]
    row = next(csv.DictReader(program("inverse", "my.toml", "--samples", "2").splitlines()))
    p = np.array([float(row[f"p_{axis}_m"]) for axis in "xyz"])
    assert [float(row[f"q_{axis}"]) for axis in "wxyz"] == [1, 0, 0, 0]
    for k, leg in enumerate(machine["leg"], 1):
        leg = {**machine["leg_defaults"], **leg}
        knee = -1 if leg.get("knee") == "negative" else 1
        of = site_legs.leg(kind, leg["base_point"], leg["base_axis"], p + leg["platform_point"], leg["proximal"].get("length", 0.1),
                           leg["distal"]["length"], knee)
        names = [name for name in ("phi", "psi", "theta", "d") if name in of]
        assert len(names) == 3
        for name in names:
            found = float(row[f"{name}_{k}_m" if name == "d" else f"{name}_{k}_rad"])
            assert abs(of[name] - found) < 1e-12, (kind, k, name)  # some thousand roundings of a metre or a radian
        assert np.linalg.norm(of["R"] + leg["distal"]["length"] * of["s"] - of["B"]) < 1e-12
        wrong = site_legs.leg(kind, leg["base_point"], -np.array(leg["base_axis"]), p + leg["platform_point"],
                              leg["proximal"].get("length", 0.1), leg["distal"]["length"], knee)
        assert any(abs(wrong[name] - of[name]) > 1e-3 for name in names)


@pytest.mark.parametrize("kind", site_legs.LEGS)
def test_a_drawing_is_well_formed_and_names_its_points(kind):
    drawing = ElementTree.fromstring(site_legs.draw(kind))
    words = [each.text for each in drawing.iter("{http://www.w3.org/2000/svg}text")]
    assert {"A", "B", "ψ"} <= set(words) and ("d" in words) == (kind in ("UPS", "PUS"))
