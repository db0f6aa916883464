"""Scenarios of dicts and of text, and back."""

import pickle
import tomllib
from pathlib import Path

import numpy as np
import pytest

import ursula
from conftest import ROOT

ALL = sorted((ROOT / "scenarios").glob("*.toml"))


def efforts(s):
    return s.inverse_dynamics(s.motion(np.linspace(0, s.duration, 7)))


@pytest.mark.parametrize("file", ALL, ids=lambda file: file.stem)
def test_round_trips_give_the_same_scenario(file, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    s = ursula.read_scenario(file)
    assert s.to_toml() == file.read_text()
    by_text = ursula.scenario(s.to_toml(), folder=file.parent)
    by_dict = ursula.scenario(s.to_dict())
    for each in (by_text, by_dict, pickle.loads(pickle.dumps(by_dict)), ursula.scenario(by_dict.to_toml())):
        assert each.name == s.name and each.to_dict() == s.to_dict()
        assert np.array_equal(efforts(each), efforts(s))
    expected = tomllib.loads(file.read_text())
    for part in ("trajectory", "load"):
        if "file" in expected.get(part, {}):
            expected[part]["file"] = str((file.parent / expected[part]["file"]).resolve())
    assert s.to_dict() == expected


def test_text_gives_the_same_hash(quick):
    s = ursula.read_scenario(quick)
    hashes = [ursula.validate(each, time_limit=1e-9).summary["provenance"]["scenario sha1"]
              for each in (s, ursula.scenario(s.to_toml()), ursula.scenario(s.to_toml() + "\n"))]
    assert hashes[0] == hashes[1] != hashes[2]


def test_a_dict_is_changed_as_people_do(helix):
    given = ursula.read_scenario(helix).to_dict()
    heavier = ursula.scenario(given)
    given["manipulator"]["platform"]["mass"] = np.float32(512)
    given["manipulator"]["platform"]["inertia"] = np.array([800, 800, 800])
    given["manipulator"]["gravity"] = (0, 0, np.int64(-9))
    changed = ursula.scenario(given)
    assert changed.to_dict()["manipulator"]["platform"] == {
        "mass": 512.0, "center_of_mass": [0.0, 0.0, 1.88], "inertia": [800, 800, 800]}
    assert np.abs(efforts(changed) - efforts(heavier)).max() > 1


def test_paths_may_stand_in_a_dict():
    file = next(each for each in ALL if 'file = "' in each.read_text())
    given = ursula.read_scenario(file).to_dict()
    part = next(each for each in ("trajectory", "load") if "file" in given.get(each, {}))
    given[part]["file"] = Path(given[part]["file"])
    assert np.array_equal(efforts(ursula.scenario(given)), efforts(ursula.read_scenario(file)))


def without(given, *keys):
    for key in keys[:-1]:
        given = given[key]
    del given[keys[-1]]


def put(given, value, *keys):
    for key in keys[:-1]:
        given = given[key]
    given[keys[-1]] = value


@pytest.mark.parametrize("change, words", [
    (lambda d: put(d, -1.0, "manipulator", "platform", "mass"), r"<dict>:\d+:\d+: error: .*manipulator.platform.mass"),
    (lambda d: put(d, 1.0, "manipulator", "platform", "mas"), "unknown key 'mas' in manipulator.platform"),
    (lambda d: without(d, "trajectory", "radius"), "missing key 'radius' in trajectory"),
    (lambda d: put(d, np.nan, "manipulator", "leg", 3, "base_point", 1),
     r"<dict>: error: manipulator.leg\[4\].base_point\[2\]: nan, expected a finite number"),
    (lambda d: put(d, None, "manipulator", "platform", "mass"), "manipulator.platform.mass: NoneType, expected a number"),
    (lambda d: put(d, 1j, "manipulator", "platform", "mass"), "manipulator.platform.mass: complex, expected a number"),
    (lambda d: put(d, np.array(["a"]), "manipulator", "gravity"), "manipulator.gravity: an array of 1, expected"),
    (lambda d: put(d, 2.0, "manipulator", 7), "manipulator: the key 7, expected a string"),
    (lambda d: put(d, 10**30, "simulation"), "simulation: a float, expected a table"),
])
def test_what_is_wrong_in_a_dict_is_refused_with_its_place(helix, change, words):
    given = ursula.read_scenario(helix).to_dict()
    change(given)
    with pytest.raises(ursula.ScenarioError, match=words):
        ursula.scenario(given)


def test_what_is_wrong_in_a_text_is_refused_with_its_place(helix):
    text = helix.read_text().replace("mass = 500.0", "mass = -500.0")
    line = text[:text.index("mass = -500.0")].count("\n") + 1
    with pytest.raises(ursula.ScenarioError, match=rf"^<text>:{line}:8: error: "):
        ursula.scenario(text)
    with pytest.raises(ursula.ScenarioError, match=r"^<text>:1:\d+: error: .*expected "):
        ursula.scenario("scenarios/paper-helix.toml")


def test_what_is_neither_is_refused(helix):
    for wrong in (3, None, helix, [1]):
        with pytest.raises(TypeError, match="expected a dict or text in TOML, found .*; read_scenario reads files"):
            ursula.scenario(wrong)
    loop = {}
    loop["manipulator"] = loop
    with pytest.raises(RecursionError):
        ursula.scenario(loop)
