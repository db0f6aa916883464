"""simulate, check, map, compare and direct kinematics: the program's numbers, and clear errors."""

import csv
import io
import pickle
import warnings

import numpy as np
import pytest

import ursula
from test_module import instants


def columns_of(text):
    rows = list(csv.DictReader(io.StringIO(text)))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def torques(s, count=101):
    m = s.motion(instants(s, count))
    return m.t, s.inverse_dynamics(m)


def write_csv(path, t, tau):
    rows = [",".join(["t_s", *(f"tau_{i + 1}_Nm" for i in range(6))])]
    rows += [",".join(repr(float(each)) for each in (at, *row)) for at, row in zip(t, tau)]
    path.write_text("\n".join(rows) + "\n")


@pytest.mark.parametrize("engine", ["noc", "simbody"])
def test_simulate_is_the_programs(engine, program, helix, tmp_path):
    s = ursula.read_scenario(helix)
    t, tau = torques(s)
    tau = 1.001 * tau[:41]
    t = t[:41]
    run = ursula.simulate(s, tau, t, engine=engine)
    write_csv(tmp_path / "tau.csv", t, tau)
    table = columns_of(program("simulate", helix, "--torques", "tau.csv", "--engine", engine).stdout)
    assert run.gave_up is None and np.array_equal(run.motion.t, t)
    assert np.allclose(run.tau, tau, rtol=1e-12)
    assert all(np.array_equal(run.tau[:, i], table[f"tau_{i + 1}_Nm"]) for i in range(6))
    for k, axis in enumerate("xyz"):
        assert np.array_equal(run.motion.p[:, k], table[f"p_{axis}_m"])
    assert np.abs(run.motion.p - s.motion(t).p).max() > 1e-6, "other torques make another motion"
    again = pickle.loads(pickle.dumps(run))
    assert np.array_equal(again.motion.p, run.motion.p) and np.array_equal(again.tau, run.tau) and again.gave_up is None


def test_what_simulate_cannot_take_is_refused(helix):
    s = ursula.read_scenario(helix)
    t, tau = torques(s)
    with pytest.raises(ValueError, match="engine: 'mujoco', expected 'noc' or 'simbody'"):
        ursula.simulate(s, tau, t, engine="mujoco")
    with pytest.raises(ValueError, match="5 instants, expected at least 6"):
        ursula.simulate(s, tau[:5], t[:5])
    with pytest.raises(ValueError, match="expected increasing instants"):
        ursula.simulate(s, tau, t[::-1])
    with pytest.raises(ValueError, match="torques: 100 rows"):
        ursula.simulate(s, tau[1:], t)
    stopped = ursula.simulate(s, tau, t, time_limit=1e-9)
    assert "time limit" in stopped.gave_up and len(stopped.motion) < len(t)


def test_check_warns_and_refuses(program, helix, tmp_path):
    odd = tmp_path / "odd.toml"
    odd.write_text(helix.read_text().replace("mass = 500.0", "mass = 5e-7"))
    with pytest.warns(UserWarning, match="odd.toml:.*: warning: ") as warned:
        s = ursula.read_scenario(odd)
    found = ursula.check(s)
    assert [str(each.message) for each in warned] == found and warned[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ursula.read_scenario(helix)
        with pytest.raises(UserWarning, match="mass"):
            ursula.scenario(odd.read_text())
    assert found and all(each in program("check", odd).stdout for each in found)
    right = ursula.check(ursula.read_scenario(helix))
    assert right == []
    assert {"kind": "missing_term", "term": "friction", "body": "all"} in [one["cause"] for one in right.blind]
    assert all(one["mistake"] and one["largest"] < 1e-9 for one in right.blind)
    assert pickle.loads(pickle.dumps(right)).blind == right.blind
    far = ursula.scenario(helix.read_text().replace("radius = 0.2", "radius = 20.0"))
    with pytest.raises(ursula.ScenarioError, match="the motion cannot be made"):
        ursula.check(far)
    assert "<svg" in far._repr_svg_()


def test_map_is_the_programs(program, helix):
    s = ursula.read_scenario(helix)
    found = ursula.map(s, x=(-0.1, 0.1, 5), z=(0.2, 0.6, 3), yaw=10, at=0.5)
    table = columns_of(program("map", helix, "--x", "-0.1,0.1,5", "--z", "0.2,0.6,3", "--yaw", "10", "--at", "0.5").stdout)
    assert list(found) == list(table) and len(found["reach"]) == 15
    for name, column in table.items():
        assert np.array_equal(found[name], column, equal_nan=True), name
    assert len(np.unique(found["kappa_B"])) > 5


def test_a_map_that_cannot_be_is_refused(helix):
    s = ursula.read_scenario(helix)
    for wrong, words in (({"x": (0, 1)}, "x"), ({"x": (0, 1, 3)}, "two or three"), ({"x": "a"}, "x"), ({"at": 9.0}, "9"),
                         ({"jobs": -1}, "jobs: -1, expected 0 or more")):
        with pytest.raises(ValueError, match=words):
            ursula.map(s, **wrong)
    with pytest.raises(ValueError, match=r"^x is <object object .*, expected a number or \(from, to, count\)$"):
        ursula.map(s, x=object())


def test_compare_is_the_programs(program, quick, tmp_path):
    s = ursula.read_scenario(quick)
    r = ursula.validate(s)
    r.write(tmp_path / "a")
    other = dict(r.timeseries)
    other["p_x_m"] = other["p_x_m"] + 1e-6
    del other["p_y_m"]
    for same in (ursula.compare(r, r), ursula.compare(tmp_path / "a", str(tmp_path / "a" / "timeseries.csv")),
                 ursula.compare(r.timeseries, tmp_path / "a")):
        assert same.verdict == "pass" and all(each.verdict == "pass" for each in same.channels)
    assert str(ursula.compare(tmp_path / "a", tmp_path / "a")) == program("compare", "a", "a").stdout
    found = ursula.compare(r, other)
    assert found.verdict == "fail" and found.only_in_reference == ["p_y_m"] and found.only_in_test == []
    off = {each.name: each for each in found.channels if each.verdict != "pass"}
    assert list(off) == ["p_x_m"] and off["p_x_m"].max_error == pytest.approx(1e-6)
    assert ursula.compare(r, other, tolerance=1e-3, columns=["p_x_m"]).verdict == "pass"


def test_what_cannot_be_compared_is_refused(quick, tmp_path):
    good = {"t_s": [0.0, 1.0], "p_x_m": [1.0, 2.0]}
    assert ursula.compare(good, good).verdict == "pass"
    for wrong, words in (({"p_x_m": [1.0]}, "t_s"), ({**good, "p_x_m": [1.0]}, r"test\['p_x_m'\]: shape \(1,\)"),
                         ({**good, "t_s": [1.0, 0.0]}, "does not increase"), ({**good, "p_x_m": ["a", "b"]}, "numbers"),
                         (tmp_path / "none.csv", "none.csv")):
        with pytest.raises(ValueError, match=words):
            ursula.compare(good, wrong)
    with pytest.raises(TypeError, match="test: expected a Result, a dict of arrays, or the path"):
        ursula.compare(good, 3)
    with pytest.raises(ValueError, match="tolerance is -1.0,"):
        ursula.compare(good, good, tolerance=-1)


def test_direct_kinematics_of_telescopic_legs(program, tmp_path):
    assert program("init", "machine.toml", "--kind", "UPS").returncode == 0
    s = ursula.read_scenario(tmp_path / "machine.toml")
    m = s.motion(0.4 * s.duration)
    d = s.inverse_kinematics(m)["d"][0]
    poses = s.direct_kinematics(d)
    table = columns_of(program("direct", "machine.toml", "--d", ",".join(map(repr, map(float, d)))).stdout)
    assert np.array_equal([pose.p for pose in poses], np.column_stack([table[f"p_{axis}_m"] for axis in "xyz"]))
    near = min(poses, key=lambda pose: np.abs(pose.p - m.p[0]).max() + np.abs(pose.Q - m.Q[0]).max())
    assert np.abs(near.p - m.p[0]).max() < 1e-9 and near.assembles and "ursula.Pose p=[" in repr(near)
    assert np.abs(s.direct_kinematics(1.01 * d)[0].p - poses[0].p).max() > 1e-3
    assert not any(pose.assembles for pose in s.direct_kinematics(10 * d))
    for wrong, words in ((d[:5], r"coordinates: shape \(5,\)"), (-d, "not negative"), (np.nan * d, "not finite"),
                         ([d, d], "of one pose")):
        with pytest.raises(ValueError, match=words):
            s.direct_kinematics(wrong)
