"""Derivatives of the efforts: against differences of inverse_dynamics, and the regressor against the efforts."""

import numpy as np
import pytest

import ursula

STEP = 1e-6


def product(a, b):
    """Of quaternions [w, x, y, z]."""
    w = a[:, :1] * b[:, :1] - (a[:, 1:] * b[:, 1:]).sum(axis=1, keepdims=True)
    return np.hstack([w, a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])])


def changed(m, name, k, h):
    parts = {"p": m.p.copy(), "q": m.q.copy(), "v": m.v.copy(), "w": m.w.copy(), "a": m.a.copy(), "alpha": m.alpha.copy()}
    if name == "orientation":
        turn = np.zeros((1, 4))
        turn[0, 0], turn[0, 1 + k] = np.cos(h / 2), np.sin(h / 2)
        parts["q"] = product(turn, parts["q"])
    else:
        parts[name][:, k] += h
    return ursula.Motion(m.t, **parts)


def read(helix, name):
    return ursula.read_scenario(helix.parent / f"{name}.toml")


@pytest.mark.parametrize("name", ["paper-helix", "mixture", "load-base", "load-platform"])
def test_by_state_are_differences(name, helix):
    scenario = read(helix, name)
    m = scenario.motion(np.linspace(0.1, 0.9, 5) * scenario.duration)
    found = scenario.effort_derivatives(m)
    assert sorted(found) == ["a", "alpha", "orientation", "p", "v", "w"]
    for by, block in found.items():
        assert block.shape == (5, 6, 3)
        for k in range(3):
            above, below = (scenario.inverse_dynamics(changed(m, by, k, h)) for h in (STEP, -STEP))
            difference = (above - below) / (2 * STEP)
            size = np.abs(block).max() + np.abs(above).max()
            assert np.abs(difference - block[:, :, k]).max() < 1e-6 * size, (by, k)
    assert np.abs(found["p"] - found["v"]).max() > 1


@pytest.mark.parametrize("name", ["paper-helix", "mixture"])
def test_regressor_gives_the_efforts(name, helix):
    scenario = read(helix, name)
    m = scenario.motion(np.linspace(0.1, 0.9, 5) * scenario.duration)
    names, values, Y = scenario.regressor(m)
    assert Y.shape == (5, 6, len(names)) and values.shape == (len(names),) and "manipulator.platform.first_moment.2" in names
    by_names, slopes = scenario.parameter_derivatives(m)
    assert slopes.shape == (5, 6, len(by_names)) and "manipulator.leg.2.distal.mass" in by_names
    tau = scenario.inverse_dynamics(m)
    assert np.abs(Y @ values - tau).max() < 1e-11 * np.abs(tau).max()
    assert np.abs(Y @ (1.001 * values) - tau).max() > 1e-4 * np.abs(tau).max()


def test_poses_out_of_reach_are_refused(helix):
    s = ursula.read_scenario(helix)
    m = ursula.Motion(0, [[0, 0, 100]], [1, 0, 0, 0])
    for call in (s.effort_derivatives, s.parameter_derivatives, s.regressor):
        with pytest.raises(ursula.PoseError):
            call(m)
    assert s.effort_derivatives(s.motion([]))["p"].shape == (0, 6, 3)
