"""Machines with any closed loops, against vectors of another program, and wrong efforts of them."""

import copy
import csv
import json
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import ursula
from conftest import ROOT

LOOPS = ROOT / "tests" / "vectors" / "loops"
SHIPPED = ROOT / "scenarios" / "mechanisms"
NAMES = ["fourbar", "planar3rrr", "delta", "ankle"]


def vectors(name):
    with open(LOOPS / f"{name}.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def columns(table, quantity, n):
    return np.column_stack([next(table[key] for key in table if key.startswith(f"{quantity}_{k}_")) for k in range(1, n + 1)])


def close(found, expected, tolerance=1e-12):
    assert np.shape(found) == np.shape(expected)
    assert np.max(np.abs(found - expected)) <= tolerance * max(1.0, np.max(np.abs(expected)))


@pytest.fixture
def quick(tmp_path):
    """A shipped scenario with few instants, for speed."""
    def of(name):
        text = (SHIPPED / f"{name}.toml").read_text(encoding="utf-8").replace(f'"{name}.xml"', f"'{SHIPPED / name}.xml'")
        file = tmp_path / f"{name}.toml"
        file.write_text(text + "\n[simulation]\nsamples = 11\n", encoding="utf-8")
        return file
    return of


@pytest.mark.parametrize("name", NAMES)
def test_vectors(name):
    s, table = ursula.read_scenario(LOOPS / f"{name}.toml"), vectors(name)
    n = len(s.motors)
    m = s.motion(table["t_s"])
    for quantity, found in (("q", m.q), ("qdot", m.qdot), ("qddot", m.qddot)):
        close(found, columns(table, quantity, n))
    tau = s.inverse_dynamics(m)
    close(tau, columns(table, "tau", n))
    close(s.direct_dynamics(m, tau), m.qddot, 1e-10)
    others = [key for key in table if key in m.joints]
    assert len(others) > 1 or n > 1
    for key in others:
        close(m.joints[key], table[key])


def test_changed_efforts_are_not_the_vectors():
    s, table = ursula.read_scenario(LOOPS / "delta.toml"), vectors("delta")
    m = s.motion(table["t_s"])
    with pytest.raises(AssertionError):
        close(s.inverse_dynamics(m) * (1 + 1e-9), columns(table, "tau", 3))
    with pytest.raises(AssertionError):
        close(s.direct_dynamics(m, 1.000001 * s.inverse_dynamics(m)), m.qddot, 1e-10)


def test_what_a_scenario_says():
    s = ursula.read_scenario(SHIPPED / "fivebar.toml")
    assert isinstance(s, ursula.MechanismScenario)
    assert (s.name, s.duration, s.motors) == ("fivebar", 2.0, ["left", "right"])
    assert s.file.name == "fivebar.toml" and s.model.name == "fivebar.xml"
    mass = {body.name: body.mass for body in s.bodies}
    assert mass["tool"] == 0.25 and mass["left_arm"] == 0.6
    tool = next(body for body in s.bodies if body.name == "tool")
    close(tool.center_of_mass, np.array([0, 0, 0.38]))
    close(tool.inertia, 2e-4 * np.eye(3))
    assert any(body.fixed for body in s.bodies)
    assert repr(s) == "<ursula.MechanismScenario 'fivebar'>"


def test_rates_of_other_joints_are_their_derivatives():
    s = ursula.read_scenario(SHIPPED / "delta.toml")
    h, t = 1e-4, np.array([0.3, 1.1])
    before, m, after = s.motion(t - h), s.motion(t), s.motion(t + h)
    assert len(m.joints) == 12 + 7 and set(m.joints) == set(m.joint_rates) == set(m.joint_accelerations)
    for name in m.joints:  # a quaternion's numbers too
        close(m.joint_rates[name], (after.joints[name] - before.joints[name]) / (2 * h), 1e-6)
        close(m.joint_accelerations[name], (after.joint_rates[name] - before.joint_rates[name]) / (2 * h), 1e-6)


def test_rows_slices_copies_and_pickles():
    s = ursula.read_scenario(SHIPPED / "fivebar.toml")
    m = s.motion(np.linspace(0, s.duration, 5))
    assert len(m) == 5 and m.q.shape == (5, 2) and not m.q.flags.writeable
    assert len(m[1:3]) == 2 and np.array_equal(m[-1].q[0], m.q[4]) and np.array_equal(m[::2].joints["left_elbow_rad"], m.joints["left_elbow_rad"][::2])
    assert repr(m[0]) == "<ursula.MechanismMotion of 1 instant>"
    with pytest.raises(IndexError):
        m[5]
    assert len(s.motion([])) == 0 and s.inverse_dynamics(s.motion([])).shape == (0, 2)
    again, moved = pickle.loads(pickle.dumps(s)), pickle.loads(pickle.dumps(m))
    assert np.array_equal(again.inverse_dynamics(moved), s.inverse_dynamics(m))
    assert np.array_equal(moved.joint_accelerations["left_elbow_rad"], m.joint_accelerations["left_elbow_rad"])
    assert copy.deepcopy(s) is s and copy.copy(m) is m
    assert np.array_equal(ursula.scenario(s.to_toml(), folder=SHIPPED).inverse_dynamics(m), s.inverse_dynamics(m))


def test_own_solver(quick, tmp_path):
    r = ursula.validate(quick("fourbar"))
    assert r.verdict == "pass", r.reason
    assert r.summary["kind"] == "mechanism"
    assert r.write(tmp_path / "out") is None
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["verdict"] == "pass"
    assert (tmp_path / "out" / "report.html").is_file()
    assert pickle.loads(pickle.dumps(r)).summary["kind"] == "mechanism"


@pytest.mark.parametrize("factor, verdict", [(1.0, "pass"), (1 + 1e-6, "fail"), (-1.0, "fail")])
def test_function(quick, factor, verdict):
    s = ursula.read_scenario(quick("fivebar"))
    sizes = []

    def mine(m):
        sizes.append(len(m))
        assert m.q.shape == (len(m), 2) and m.joints["left_elbow_rad"].shape == (len(m),)
        return factor * s.inverse_dynamics(m)

    r = ursula.validate(s, mine)
    assert r.verdict == verdict, r.reason
    assert max(sizes) >= 11 and r.checks and r.summary["provenance"]["subject"] == "mine"


def test_function_within_a_tolerance(quick):
    s = ursula.read_scenario(quick("delta"))
    assert ursula.validate(s, lambda m: 1.001 * s.inverse_dynamics(m), rtol="1%").verdict == "pass"
    assert ursula.validate(s, lambda m: 1.1 * s.inverse_dynamics(m), rtol="1%").verdict == "fail"


def test_a_slow_function_in_pieces_with_progress(quick):
    s, sizes, told = ursula.read_scenario(quick("fivebar")), [], []

    def mine(m):
        sizes.append(len(m))
        return s.inverse_dynamics(m)

    r = ursula.validate(s, mine, progress=lambda share, now: told.append(share))
    assert r.verdict == "pass" and sum(sizes) <= 2000 and len(sizes) > 2 and told == sorted(told) and told
    sizes.clear()
    assert ursula.validate(s, mine, thorough=True).verdict == "pass"
    assert sum(sizes) > 8000
    sizes.clear()
    assert ursula.validate(s, mine, quick=True).verdict == "pass"
    assert sum(sizes) == 11


@pytest.mark.parametrize("name", ["fourbar", "fivebar", "delta"])
def test_a_simulator(quick, name):
    s, asked = ursula.read_scenario(quick(name)), []
    n = len(s.motors)

    def mine(m, tau, factor=1.0):
        assert tau.shape == (len(m), n) and not m.qddot.any()
        asked.append(len(m))
        return s.direct_dynamics(m, factor * tau)

    r = ursula.validate(s, accelerations=mine)
    assert r.verdict == "pass", r.reason
    assert sum(asked) <= 2000
    r = ursula.validate(s, accelerations=lambda m, tau: mine(m, tau, 1.0001))
    assert r.verdict == "fail" and r.cause is not None and r.cause.kind == "scale"
    light = ursula.validate(s, accelerations=lambda m, tau: 1.0001 * mine(m, tau))
    assert light.verdict == "fail"


def test_torques(quick):
    s = ursula.read_scenario(quick("delta"))
    t = np.linspace(0, s.duration, 201)
    tau = s.inverse_dynamics(s.motion(t))
    assert ursula.validate(s, torques=tau, t=t, rtol=1e-6).verdict == "pass"
    assert ursula.validate(s, torques=tau, t=t).verdict != "fail"
    wrong = tau.copy()
    wrong[:, 1] *= 1.01
    r = ursula.validate(s, torques=wrong, t=t, rtol=1e-6)
    assert r.verdict == "fail" and r.deviation.largest > 0


@pytest.mark.parametrize("call, words", [
    (lambda s, t, tau: ursula.validate(s, torques=tau[:, :2], t=t), r"torques: shape \(11, 2\), expected \(N, 3\)"),
    (lambda s, t, tau: ursula.validate(s, torques=tau[:5], t=t), "torques: 5 rows, expected one for each of the 11 instants t"),
    (lambda s, t, tau: ursula.validate(s, torques=tau, t=t + 9), r"^t\[0\] = 9 lies outside of the motion"),
    (lambda s, t, tau: ursula.validate(s, torques=tau, t=t[::-1]), r"^t\[1\] = 1.8 does not come after 2"),
    (lambda s, t, tau: ursula.validate(s, lambda m: np.zeros((len(m), 6))), r"the solver's answer to \d+ instants has shape \(\d+, 6\), expected \(\d+, 3\)"),
    (lambda s, t, tau: ursula.validate(s, lambda m: np.full((len(m), 3), np.nan)), "the solver's effort 1 at t = 0.0 s is nan"),
    (lambda s, t, tau: s.direct_dynamics(s.motion(t), tau[:, :1]), r"tau: shape \(11, 1\), expected \(N, 3\)"),
    (lambda s, t, tau: s.direct_dynamics(s.motion(t), tau[:2]), "tau: 2 rows, expected one for each of the motion's 11"),
    (lambda s, t, tau: s.motion(9.0), r"t\[0\] = 9.0 s is outside of the motion, expected 0 to 2.0 s"),
    (lambda s, t, tau: s.inverse_dynamics(ursula.read_scenario(SHIPPED / "fourbar.toml").motion(t)), "m: a motion of 1 motors, expected 3"),
    (lambda s, t, tau: ursula.validate(s, torques=0 * tau, t=t, rtol=2.0), "efforts of zero would pass"),
])
def test_wrong_shapes(quick, call, words):
    s = ursula.read_scenario(quick("delta"))
    t = np.linspace(0, s.duration, 11)
    with pytest.raises(ValueError, match=words):
        call(s, t, s.inverse_dynamics(s.motion(t)))


def test_other_wrong_arguments(quick):
    s = ursula.read_scenario(quick("fourbar"))
    for call, words in ((lambda: ursula.validate(s, solver="mine"), "expected a function of a MechanismMotion; a command is for"),
                        (lambda: ursula.validate(s, 3), "solver is of type int"),
                        (lambda: s.inverse_dynamics(3), "m is 3 of type int, expected ursula.MechanismMotion"),
                        (lambda: ursula.simulate(3, [[1.0]], [0.0]), "s is 3 of type int, expected ursula.Scenario"),
                        (lambda: ursula.simulate(s, [[1.0]], None), "torques are given without t"),
                        (lambda: ursula.validate(3), "s is 3 of type int, expected ursula.Scenario, ursula.MechanismScenario or a path")):
        with pytest.raises(TypeError, match=words):
            call()


def test_refusals(quick):
    file = quick("fivebar")
    text = file.read_text(encoding="utf-8")
    far = quick("fourbar")
    far.write_text(far.read_text(encoding="utf-8").replace('"crank_hinge"', '"rocker_hinge"').replace("sin = [0.4", "sin = [2.0"),
                   encoding="utf-8")
    with pytest.raises(ursula.PoseError, match="t = ") as refused:
        ursula.check(ursula.read_scenario(far))
    assert refused.value.leg is None
    file.write_text(text.replace('["left", "right"]', '["left"]').replace("  { offset = 0.0, sin = [0.15], cos = [-0.1, 0.05] },\n", ""),
                    encoding="utf-8")
    with pytest.raises(ursula.ScenarioError, match="1 motor for 2 freedoms"):
        ursula.read_scenario(file).motion(0)
    file.write_text(text.replace('"left"', '"lift"'), encoding="utf-8")
    with pytest.raises(ursula.ScenarioError, match="lift"):
        ursula.read_scenario(file)
    with pytest.raises(ursula.ScenarioError, match="nowhere"):
        ursula.validate("nowhere.toml")


def test_check(quick):
    assert ursula.check(ursula.read_scenario(quick("delta"))) == []


def test_exceptions_of_a_function_reach_the_caller(quick):
    class Mine(Exception):
        pass

    def fails(m):
        raise Mine("own")

    with pytest.raises(Mine, match="own"):
        ursula.validate(quick("fourbar"), fails)


def test_other_threads_run(quick):
    s = ursula.read_scenario(quick("delta"))
    ticks, ended = [], threading.Event()

    def tick():
        while not ended.is_set():
            ticks.append(time.perf_counter())
            time.sleep(1e-3)

    thread = threading.Thread(target=tick)
    thread.start()
    ursula.validate(s)
    ended.set()
    thread.join()
    assert len(ticks) > 3


def test_time_limit(quick):
    assert ursula.validate(quick("delta"), time_limit=1e-3).verdict == "inconclusive"


class Heard(Exception):
    pass


def hear(*_):
    raise Heard


@pytest.fixture(scope="module")
def long_motion():
    text = (SHIPPED / "delta.toml").read_text(encoding="utf-8") + "\n[simulation]\nsamples = 10001\n"
    s = ursula.scenario(text, folder=SHIPPED)
    return s, s.motion(np.linspace(0, s.duration, 10001))


@pytest.mark.parametrize("call", [
    lambda s, m: s.motion(m.t),
    lambda s, m: s.inverse_dynamics(m),
    lambda s, m: s.direct_dynamics(m, np.zeros((len(m), 3))),
    lambda s, m: ursula.validate(s),
    lambda s, m: ursula.validate(s, lambda m: np.zeros((len(m), 3))),
])
def test_signals_are_heard(call, long_motion):
    before = signal.signal(signal.SIGALRM, hear)
    try:
        with pytest.raises(Heard):
            signal.setitimer(signal.ITIMER_REAL, 0.05)
            call(*long_motion)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_what_hexapods_have_mechanisms_have():
    s = ursula.read_scenario(LOOPS / "delta.toml")
    t = np.linspace(0, s.duration, 41)
    m = s.motion(t)
    tau = s.inverse_dynamics(m)
    close(s.forward_dynamics(m, tau), m.qddot, 1e-10)
    again = ursula.scenario(s.to_dict())
    assert np.array_equal(again.inverse_dynamics(m), tau)
    assert s.to_dict()["mechanism"]["motors"] == s.motors
    changed = s.to_dict()
    changed["mechanism"]["gravity"] = [0.0, 0.0, -1.0]
    assert not np.allclose(ursula.scenario(changed).inverse_dynamics(m), tau)


def test_direct_kinematics_finds_the_joints():
    s = ursula.read_scenario(LOOPS / "delta.toml")
    m = s.motion(np.linspace(0, s.duration, 21))
    found = s.direct_kinematics(m.q)
    assert np.array_equal(found.q, m.q) and not found.qdot.any() and not found.t.any()
    for name, values in m.joints.items():
        close(found.joints[name], values)
    other = s.direct_kinematics(m.q + 0.01)
    assert any(np.max(np.abs(other.joints[name] - values)) > 1e-3 for name, values in m.joints.items())
    with pytest.raises(ValueError, match=r"coordinates: shape \(21, 2\), expected"):
        s.direct_kinematics(m.q[:, :2])
    with pytest.raises(ursula.PoseError):
        s.direct_kinematics([[9.0, 0.0, 0.0]])


@pytest.mark.parametrize("engine", ["noc", "simbody"])
def test_simulate_follows_the_commanded_motion(engine):
    s = ursula.read_scenario(LOOPS / "delta.toml")
    t = np.linspace(0, 0.5, 51)
    m = s.motion(t)
    tau = s.inverse_dynamics(m)
    run = ursula.simulate(s, tau, t, engine=engine)
    assert isinstance(run.motion, ursula.MechanismMotion) and run.gave_up is None
    close(run.motion.q, m.q, 1e-6)
    close(run.tau, tau, 1e-9)
    for name, values in m.joints.items():
        close(run.motion.joints[name], values, 1e-6)
    assert np.array_equal(pickle.loads(pickle.dumps(run)).motion.q, run.motion.q)
    weaker = ursula.simulate(s, 0.99 * tau, t, engine=engine)
    assert np.max(np.abs(weaker.motion.q - m.q)) > 1e-3
    with pytest.raises(ValueError, match="torques: shape"):
        ursula.simulate(s, tau[:, :2], t)
