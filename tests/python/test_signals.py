"""Ctrl-C, and every other handler of signals, is answered while a call works on many instants.

No clock decides: the last of the instants is refused, so a call that has not listened raises that, and one that has
listened what the handler raises."""

import signal

import numpy as np
import pytest

import ursula

from conftest import ROOT

HELIX = ROOT / "scenarios" / "paper-helix.toml"
COUNT = 1_000_000


class Heard(Exception):
    pass


def hear(*_):
    raise Heard


@pytest.fixture
def alarm():
    before = signal.signal(signal.SIGALRM, hear)
    yield lambda: signal.setitimer(signal.ITIMER_REAL, 0.01)
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


@pytest.fixture(scope="module")
def s():
    return ursula.read_scenario(HELIX)


@pytest.fixture(scope="module")
def columns(s):
    """All good but the last, which is out of reach."""
    m = s.motion(1.0)
    p = np.tile(m.p, (COUNT, 1))
    p[-1, 2] = 9
    return np.linspace(0, 1, COUNT), p, np.tile(m.q, (COUNT, 1))


@pytest.fixture(scope="module")
def motion(columns):
    return ursula.Motion(*columns)


@pytest.mark.parametrize("call", [
    lambda s, m: s.inverse_dynamics(m, jobs=1),
    lambda s, m: s.forward_dynamics(m, np.zeros((len(m), 6)), jobs=1),
    lambda s, m: s.inverse_kinematics(m),
    lambda s, m: s.effort_derivatives(m),
])
def test_dynamics_of_many_instants_listen(s, motion, alarm, call):
    with pytest.raises(ursula.PoseError):
        call(s, motion[-1])
    alarm()
    with pytest.raises(Heard):
        call(s, motion)


def test_conversions_of_arrays_listen(columns, alarm):
    t, p, q = columns
    q = q.copy()
    q[-1] = 0
    with pytest.raises(ValueError, match="expected a unit quaternion"):
        ursula.Motion(t[-1:], p[-1:], q[-1:])
    alarm()
    with pytest.raises(Heard):
        ursula.Motion(t, p, q)


def test_motions_of_many_instants_listen(s, alarm):
    """Many signals in one call: a call that does not listen answers one, after it."""
    t, heard = np.linspace(0, s.duration, COUNT), []
    signal.signal(signal.SIGALRM, lambda *_: heard.append(signal.setitimer(signal.ITIMER_REAL, 0.01)))
    alarm()
    s.motion(t)
    assert len(heard) > 2
