"""Scenarios, motions and results travel between processes and into files with nothing lost."""

import copy
import filecmp
import multiprocessing
import os
import pickle
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

import ursula
from conftest import ROOT

FILES = ("summary.json", "timeseries.csv", "report.html")  # junit.xml has times


def judged(s):
    """In another process: what it has of the scenario, and what it makes of it."""
    return s.name, s.inverse_dynamics(s.motion(np.linspace(0, s.duration, 7))), ursula.validate(s)


def same(a, b):
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in ("t", "p", "Q", "v", "w", "a", "alpha"))


def test_through_another_process(quick, tmp_path):
    s = ursula.read_scenario(quick)
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        name, tau, there = pool.submit(judged, s).result()
    here = ursula.validate(s)
    assert name == s.name and np.array_equal(tau, s.inverse_dynamics(s.motion(np.linspace(0, s.duration, 7))))
    here.write(tmp_path / "here")
    there.write(tmp_path / "there")
    # The other process has read the scenario's text, and calls its file by the whole path, as `quick` is.
    assert sorted(filecmp.cmpfiles(tmp_path / "here", tmp_path / "there", FILES, shallow=False)[0]) == sorted(FILES)
    assert there.reason == here.reason and [c.name for c in there.checks] == [c.name for c in here.checks]


def test_scenarios_are_equal_by_content(quick):
    s = ursula.read_scenario(quick)
    for again in (pickle.loads(pickle.dumps(s)), ursula.scenario(s.to_dict()), ursula.read_scenario(quick)):
        assert again == s and hash(again) == hash(s) and again is not s
    other = s.to_dict()
    other["manipulator"]["platform"]["mass"] *= 1 + 1e-15
    assert ursula.scenario(other) != s and s != "a scenario"


@pytest.mark.parametrize("answer", [lambda tau: 1.001 * tau, lambda tau: tau])
def test_results_of_every_verdict(quick, tmp_path, answer):
    s = ursula.read_scenario(quick)
    r = ursula.validate(s, lambda m: answer(s.inverse_dynamics(m)))
    again = pickle.loads(pickle.dumps(r))
    r.write(tmp_path / "before")
    again.write(tmp_path / "after")
    assert sorted(filecmp.cmpfiles(tmp_path / "before", tmp_path / "after", FILES, shallow=False)[0]) == sorted(FILES)
    check = pickle.loads(pickle.dumps(r.checks[0]))
    assert (check.name, check.value, check.why) == (r.checks[0].name, r.checks[0].value, r.checks[0].why)


def test_motions(helix):
    m = ursula.read_scenario(helix).motion(np.linspace(0, 3, 11))
    assert same(pickle.loads(pickle.dumps(m)), m) and not same(m[1:], m[:-1])
    assert len(pickle.loads(pickle.dumps(m[:0]))) == 0


@pytest.mark.parametrize("file", sorted((ROOT / "scenarios").glob("*.toml")), ids=lambda file: file.stem)
def test_every_scenario_is_read_from_another_folder(file, tmp_path, monkeypatch):
    monkeypatch.chdir(file.parent)
    s = ursula.read_scenario(file.name)
    state = pickle.dumps(s)
    monkeypatch.chdir(tmp_path)
    again = pickle.loads(state)
    assert again.name == s.name and os.fspath(again.file) == str(file)
    t = np.linspace(0, s.duration, 5)
    assert same(again.motion(t), s.motion(t))
    assert np.array_equal(again.inverse_dynamics(again.motion(t)), s.inverse_dynamics(s.motion(t)))


def test_copies_of_what_cannot_change(quick):
    s = ursula.read_scenario(quick)
    r = ursula.validate(s, time_limit=1e-9)
    for each in (s, s.motion(0), r, r.checks[0]):
        assert copy.copy(each) is each and copy.deepcopy([each])[0] is each


PICKLED = []


def pickled(quick):
    """An object of each class that can be pickled; made once, as none can change."""
    if not PICKLED:
        s = ursula.read_scenario(quick)
        t = np.linspace(0, s.duration, 41)
        tau = s.inverse_dynamics(s.motion(t))
        r = ursula.validate(s, lambda m: s.inverse_dynamics(m) * np.array([1, 1, 1.001, 1, 1, 1]))
        PICKLED.extend([s, s.motion(t[:3]), r, r.checks[0], r.findings[0], r.deviation, r.cause, ursula.simulate(s, tau, t)])
        PICKLED.extend(each for each in (r.replay_error,) if each)
    return PICKLED


def test_every_class_by_every_protocol(quick):
    kinds = set()
    for each in pickled(quick):
        kinds.add(type(each).__name__)
        for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
            again = pickle.loads(pickle.dumps(each, protocol))
            assert type(again) is type(each) and repr(again) == repr(each), (each, protocol)
    assert kinds >= {"Scenario", "Motion", "Result", "Check", "Finding", "Deviation", "Cause", "Simulation"}


@pytest.mark.parametrize("protocol", (0, 1, 2))
def test_a_class_that_cannot_be_pickled_says_so(quick, protocol):
    s = ursula.read_scenario(quick)
    pose = s.direct_kinematics(s.inverse_kinematics(s.motion(0.0))["phi"][0])[0]
    with pytest.raises(TypeError, match="cannot pickle"):
        pickle.dumps(pose, protocol)


def test_a_damaged_pickle_is_refused(quick):
    """In a child process, because a damaged one that is read may end it."""
    for each in pickled(quick):
        if isinstance(each, (ursula.Scenario, ursula.Simulation)):  # text, and a Motion with an array
            continue
        version, state = each.__getstate__()
        step = max(1, len(state) // 200)
        child = os.fork()
        if child == 0:
            refused = True
            for at in [*range(0, len(state), step), len(state) - 1]:
                damaged = bytearray(state)
                damaged[at] ^= 0xc8
                try:
                    type(each).__new__(type(each)).__setstate__((version, bytes(damaged)))
                    refused = False
                except ValueError as error:
                    refused = refused and "damaged" in str(error)
            os._exit(0 if refused else 1)
        assert os.waitpid(child, 0)[1] == 0, each


def test_a_pickle_of_another_class_is_refused(quick):
    r = ursula.validate(ursula.read_scenario(quick), time_limit=1e-9)
    with pytest.raises(ValueError, match="damaged"):
        ursula.Finding.__new__(ursula.Finding).__setstate__(r.checks[0].__getstate__())


@pytest.mark.parametrize("name", ("Cause", "Check", "Deviation", "Finding", "Motion", "ReplayError", "Result", "Scenario", "Simulation"))
def test_an_object_that_was_never_made_is_refused(name):
    each = getattr(ursula, name)
    for attribute in [word for word in dir(each) if isinstance(getattr(each, word), property)]:
        with pytest.raises(TypeError, match="never called"):
            getattr(each.__new__(each), attribute)


def test_what_is_no_pickle_of_this_version_is_refused(helix):
    m = ursula.read_scenario(helix).motion(0)
    version, state = m.__getstate__()
    husk = ursula.Motion.__new__(ursula.Motion)
    with pytest.raises(ValueError, match=f"pickled by ursula 0.0.1, expected {ursula.__version__}"):
        husk.__setstate__(("0.0.1", state))
    for cut in (0, 7, len(state) - 1):
        with pytest.raises(ValueError, match="a pickle that ends early"):
            ursula.Motion.__new__(ursula.Motion).__setstate__((version, state[:cut]))
