"""A model made elsewhere as a scenario: what is exported comes back, and what cannot be read is refused."""

import os
import re
import subprocess
import warnings
from pathlib import Path

import numpy as np
import pytest
import ursula

PROGRAM = os.environ["URSULA_PROGRAM"]
ROOT = Path(__file__).resolve().parents[2]
START = {kind: ROOT / f"apps/starting/{kind}.toml" for kind in ("URS", "UPS", "RUS", "PUS")}
DRIVEN = {"URS": "leg_{}_phi", "UPS": "leg_{}_d", "RUS": "leg_{}_phi", "PUS": "leg_{}_d"}


def export(scenario, form, folder):
    file = folder / f"model.{form}"
    subprocess.run([PROGRAM, "export", scenario, "--format", form, "--out", file], check=True, capture_output=True)
    return file


@pytest.mark.parametrize("form", ["sdf", "mjcf", "urdf"])
@pytest.mark.parametrize("kind", START)
def test_an_export_comes_back(kind, form, tmp_path):
    """The efforts of the machine that comes back are those of the one that went, at motions of the latter."""
    given = ursula.read_scenario(START[kind])
    drive = [DRIVEN[kind].format(i + 1) for i in range(6)]
    if form == "sdf" and kind == "URS":
        drive = [f"leg_{i + 1}_phi_psi/axis" for i in range(6)]
    imported = ursula.import_model(export(START[kind], form, tmp_path), actuated=[] if form == "mjcf" else drive)
    motion = given.motion(np.linspace(0, given.duration, 7))
    expected, found = given.inverse_dynamics(motion), imported.inverse_dynamics(motion)
    assert np.abs(expected).max() > 1
    # Ten decimals of lengths and angles are more than any format loses.
    assert np.abs(found - expected).max() <= 1e-10 * np.abs(expected).max()
    assert all(set(each) == {"what", "where", "size", "unit", "warning"} for each in imported.assumptions)
    assert ursula.scenario(imported.to_toml()).to_dict() == imported.to_dict()


def test_a_wrong_machine_does_not(tmp_path):
    given = ursula.read_scenario(START["UPS"])
    file = export(START["UPS"], "mjcf", tmp_path)
    text = file.read_text()
    assert 'mass="' in text
    document = given.to_dict()
    document["manipulator"]["platform"]["mass"] *= 1.001
    heavier = ursula.scenario(document)
    motion = given.motion(np.linspace(0, given.duration, 7))
    imported = ursula.import_model(file)
    change = np.abs(imported.inverse_dynamics(motion) - heavier.inverse_dynamics(motion)).max()
    assert change > 1e-5 * np.abs(given.inverse_dynamics(motion)).max()


def test_a_gap_is_a_warning(tmp_path):
    """A closure that is open by 5 cm in the file's pose; the file without it says nothing."""
    file = export(START["UPS"], "urdf", tmp_path)
    drive = [DRIVEN["UPS"].format(i + 1) for i in range(6)]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not any(each["warning"] for each in ursula.import_model(file, actuated=drive).assumptions)
    text = file.read_text()
    open_text = re.sub(r'(p_BQ value=")(\S+)', lambda m: f"{m[1]}{float(m[2]) + 0.05!r}", text, count=1)
    assert open_text != text
    file.write_text(open_text)
    with pytest.warns(UserWarning, match="open at the file's initial pose"):
        imported = ursula.import_model(file, actuated=drive)
    assert [each["warning"] for each in imported.assumptions].index(True) == 0


def test_what_is_no_model_is_refused(tmp_path):
    file = tmp_path / "no.xml"
    file.write_text("<mujoco><worldbody/></mujoco>")
    with pytest.raises(ursula.ScenarioError, match="no.xml"):
        ursula.import_model(file)
    with pytest.raises(ursula.ScenarioError, match="nosuch.urdf"):
        ursula.import_model(tmp_path / "nosuch.urdf")
