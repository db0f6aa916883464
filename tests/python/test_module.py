"""Motions, dynamics and kinematics: the program's numbers, and clear errors."""

import csv
import io
import threading

import numpy as np
import pytest

import ursula

MOTION = {"p": "p_{}_m", "v": "v_{}_m_s", "w": "w_{}_rad_s", "a": "a_{}_m_s2", "alpha": "alpha_{}_rad_s2"}
JOINTS = {"": "rad", "dot": "rad_s", "ddot": "rad_s2"}


def table(program, helix, samples=37):
    run = program("inverse", helix, "--samples", samples)
    assert run.returncode == 0, run.stderr
    rows = list(csv.DictReader(io.StringIO(run.stdout)))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def instants(s, samples=37):
    return np.array([s.duration * k / (samples - 1) for k in range(samples)])


def test_the_programs_numbers(program, helix):
    s, of_program = ursula.read_scenario(helix), table(program, helix)
    m = s.motion(instants(s))
    for k in range(3):
        for name, column in MOTION.items():
            assert np.array_equal(getattr(m, name)[:, k], of_program[column.format("xyz"[k])]), name
    assert np.array_equal(m.t, of_program["t_s"])
    for k in range(4):
        assert np.array_equal(m.q[:, k], of_program[f"q_{'wxyz'[k]}"])
    tau, joints = s.inverse_dynamics(m), s.inverse_kinematics(m)
    for i in range(6):
        assert np.abs(tau[:, i] - of_program[f"tau_{i + 1}_Nm"]).max() <= 1e-14 * np.abs(tau).max(), "kernels against NOC"
        for rate, unit in JOINTS.items():
            for angle in ("phi", "psi", "theta"):
                assert np.array_equal(joints[angle + rate][:, i], of_program[f"{angle}{rate}_{i + 1}_{unit}"])
    assert np.abs(np.diff(tau, axis=0)).max() > 1, "torques that change nothing would compare equal in any order"


def test_direct_dynamics_undo_inverse_dynamics(helix):
    s = ursula.read_scenario(helix)
    m = s.motion(instants(s))
    tau = s.inverse_dynamics(m)
    a, alpha = s.forward_dynamics(m, tau)
    assert a.shape == alpha.shape == (len(m), 3)
    assert np.allclose(a, m.a, rtol=0, atol=1e-12) and np.allclose(alpha, m.alpha, rtol=0, atol=1e-12)
    a, _ = s.forward_dynamics(m, 1.001 * tau)
    assert not np.allclose(a, m.a, rtol=0, atol=1e-6)


@pytest.mark.parametrize("kind", ["UPS", "RUS", "PUS"])
def test_legs_of_every_kind(kind, program, tmp_path):
    assert program("init", "machine.toml", "--kind", kind).returncode == 0
    s = ursula.read_scenario(tmp_path / "machine.toml")
    of_program = table(program, tmp_path / "machine.toml")
    m = s.motion(instants(s))
    tau, joints = s.inverse_dynamics(m), s.inverse_kinematics(m)
    has = {"UPS": ["phi", "psi", "d"], "RUS": ["phi", "psi", "theta"], "PUS": ["d", "psi", "theta"]}[kind]
    assert sorted(joints) == sorted(name + rate for name in has for rate in JOINTS)
    for i in range(6):
        of_motor = of_program[f"tau_{i + 1}_{'Nm' if kind == 'RUS' else 'N'}"]
        assert np.abs(tau[:, i] - of_motor).max() <= 1e-13 * np.abs(tau).max(), "kernels against NOC"
        for name in has:
            for rate, unit in JOINTS.items():
                column = f"{name}{rate}_{i + 1}_{unit.replace('rad', 'm') if name == 'd' else unit}"
                assert np.array_equal(joints[name + rate][:, i], of_program[column])
    a, alpha = s.forward_dynamics(m, tau)
    assert np.allclose(a, m.a, rtol=0, atol=1e-11) and np.allclose(alpha, m.alpha, rtol=0, atol=1e-11)
    joints = s.inverse_kinematics(m[1])
    poses = s.direct_kinematics(joints["phi" if kind in ("URS", "RUS") else "d"][0])
    apart, pose = min((np.abs(pose.p - m.p[1]).max() + np.abs(pose.Q - m.Q[1]).max(), k)
                      for k, pose in enumerate(poses))
    assert apart < 1e-9 and poses[pose].front and poses[pose].assembles


def test_any_number_of_threads_gives_the_same_numbers(helix):
    s = ursula.read_scenario(helix)
    m = s.motion(np.linspace(0, s.duration, 5003))
    tau = s.inverse_dynamics(m, jobs=1)
    a, alpha = s.forward_dynamics(m, 1.1 * tau, jobs=1)
    assert np.array_equal(tau[4000:4007], s.inverse_dynamics(m[4000:4007])), "nor does it matter what is beside a row"
    for jobs in (0, 2, 7):
        assert np.array_equal(s.inverse_dynamics(m, jobs=jobs), tau)
        for found, expected in zip(s.forward_dynamics(m, 1.1 * tau, jobs=jobs), (a, alpha)):
            assert np.array_equal(found, expected)
    assert not np.array_equal(tau, 1.1 * tau)
    for call in (lambda: s.inverse_dynamics(m, jobs=-1), lambda: s.forward_dynamics(m, tau, jobs=-1)):
        with pytest.raises(ValueError, match="jobs: -1, expected 0 or more"):
            call()


def test_of_many_poses_the_first_that_cannot_be_is_refused(helix):
    s = ursula.read_scenario(helix)
    m = s.motion(np.linspace(0, s.duration, 4000))
    p = m.p.copy()
    p[1234, 2] = p[3000, 2] = 9
    wrong = ursula.Motion(m.t, p, m.q, m.v, m.w, m.a, m.alpha)
    for call in (lambda: s.inverse_dynamics(wrong), lambda: s.forward_dynamics(wrong, np.zeros((4000, 6)))):
        with pytest.raises(ursula.PoseError, match="leg 1 is out of reach") as refused:
            call()
        assert refused.value.instant == m.t[1234] and refused.value.leg == 1


def test_direct_kinematics_find_the_pose(helix):
    s = ursula.read_scenario(helix)
    m = s.motion(1.2)
    poses = s.direct_kinematics(s.inverse_kinematics(m)["phi"][0])
    assert min(np.abs(pose.p - m.p[0]).max() + np.abs(pose.Q - m.Q[0]).max() for pose in poses) < 1e-9
    assert poses[0].assembles and poses[0].q.shape == (4,)
    with pytest.raises(ValueError, match=r"coordinates: shape \(5,\), expected \(N, 6\)"):
        s.direct_kinematics(np.zeros(5))


def test_motions_are_what_was_given_and_stay_it(helix):
    s = ursula.read_scenario(helix)
    m = s.motion(instants(s))
    again = ursula.Motion(m.t, m.p, m.q, m.v, m.w, m.a, m.alpha)
    for name in ("t", *MOTION):
        assert np.array_equal(getattr(again, name), getattr(m, name))
        with pytest.raises(ValueError, match="read-only"):
            getattr(m, name)[0] = 1
    assert np.allclose(again.Q, m.Q, rtol=0, atol=1e-15)
    assert np.allclose(np.einsum("nij,nkj->nik", m.Q, m.Q), np.eye(3), rtol=0, atol=1e-14)
    assert np.array_equal(m[5:9].p, m.p[5:9]) and np.array_equal(m[-1].t, m.t[-1:])
    with pytest.raises(IndexError):
        m[len(m)]
    p = s.motion(1.0).p  # outlives its motion
    assert np.array_equal(p, s.motion([1.0]).p)
    assert len(s.motion([])) == 0 and s.motion([]).p.shape == (0, 3)
    assert s.inverse_dynamics(s.motion([])).shape == (0, 6)


def test_wrong_motions_are_refused(helix):
    s = ursula.read_scenario(helix)
    with pytest.raises(ValueError, match=r"t\[1\] is not finite"):
        s.motion([0, np.nan])
    for no_numbers, found in (("soon", "text"), (1j, "complex128"), (np.datetime64("2000-01-01"), "datetime64"),
                              (None, "object"), (np.ma.masked_all(3), "a masked array"), ([True], "bool")):
        with pytest.raises(ValueError, match=r"t: expected real numbers \(found " + found):
            s.motion(no_numbers)
    with pytest.raises(ValueError, match=r"p: shape \(2, 2\), expected \(N, 3\)"):
        ursula.Motion(0, [[0, 0], [0, 0]], [1, 0, 0, 0])
    with pytest.raises(ValueError, match="expected a unit quaternion"):
        ursula.Motion(0, [0, 0, 1], [0, 0, 0, 0])
    with pytest.raises(ValueError, match="not finite"):
        ursula.Motion(0, [0, np.inf, 1], [1, 0, 0, 0])
    with pytest.raises(ValueError, match="2 rows, expected one for each of the motion's 1"):
        s.forward_dynamics(s.motion(0), np.zeros((2, 6)))


def test_what_is_not_finite_is_refused_with_its_place(helix):
    s = ursula.read_scenario(helix)
    m = s.motion(np.linspace(0, s.duration, 700))  # more than one thread takes
    tau = s.inverse_dynamics(m)
    tau[432, 1] = np.nan
    with pytest.raises(ValueError, match=r"tau\[432, 1\] is not finite"):
        s.forward_dynamics(m, tau)
    at = f"at t = {m.t[432]:.9g} s, expected a finite number"
    v = m.v.copy()
    v[432] = 1e200
    fast = ursula.Motion(m.t, m.p, m.q, v, m.w, m.a, m.alpha)
    for call, what in ((s.inverse_dynamics, "effort"), (lambda m: s.forward_dynamics(m, np.zeros((700, 6))), "twist rate"),
                       (s.inverse_kinematics, "joint variable"), (s.effort_derivatives, "effort"),
                       (s.parameter_derivatives, "derivative"), (s.regressor, "derivative")):
        with pytest.raises(ValueError, match=what + r" [0-9]+ = -?(inf|nan) " + at):
            call(fast)


def test_instants_beyond_the_motion_are_refused_but_for_rounding(helix, tmp_path):
    odd = tmp_path / "odd.toml"
    odd.write_text(helix.read_text().replace("duration = 3.0", "duration = 0.3", 1))
    s = ursula.read_scenario(odd)
    end = s.motion(s.duration)
    for t in (np.arange(0, 0.35, 0.1)[-1], np.nextafter(0.3, 1)):
        assert t > s.duration
        assert s.motion(t).t[0] == s.duration and np.array_equal(s.motion(t).p, end.p)
    assert s.motion(-1e-17).t[0] == 0
    with pytest.raises(ValueError, match=r"t\[2\] = 0.4 s is outside of the motion, expected 0 to 0.3 s"):
        s.motion([0, 0.3, 0.4, 0.5])
    for t in (-1e-9, 0.3 * (1 + 1e-14), 1e300):
        with pytest.raises(ValueError, match=r"t\[0\] = .* s is outside of the motion"):
            s.motion(t)


@pytest.mark.parametrize("name", ["Scenario", "Motion", "Pose", "Check", "Result"])
def test_what_was_never_initialised_is_refused(name, helix):
    kind = getattr(ursula._ursula, name)
    attributes = [each for each, what in vars(kind).items() if isinstance(what, property)]
    assert attributes
    for cls in (kind, type("Mine", (kind,), {})):
        husk = cls.__new__(cls)
        for attribute in attributes:
            with pytest.raises(TypeError, match=name + r": __init__\(\) was never called"):
                getattr(husk, attribute)
    s = ursula.read_scenario(helix)
    for call in (s.inverse_dynamics, s.inverse_kinematics, ursula.validate):
        with pytest.raises(TypeError):
            call(kind.__new__(kind))


def test_errors_are_the_programs(program, helix, tmp_path):
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(helix.read_text().replace("mass = 500.0", "mass = -500.0"))
    with pytest.raises(ursula.ScenarioError) as refused:
        ursula.read_scenario(wrong)
    assert isinstance(refused.value, ValueError)
    run = program("inverse", wrong)
    assert run.returncode == 2 and run.stderr.strip() == str(refused.value)
    with pytest.raises(ursula.ScenarioError, match="no-such.toml"):
        ursula.read_scenario("no-such.toml")
    with pytest.raises(ursula.PoseError, match="leg 1 is out of reach at t = 2 s") as refused:
        s = ursula.read_scenario(helix)
        s.inverse_dynamics(ursula.Motion([2.0], [[0, 0, 9]], [[1, 0, 0, 0]]))
    assert isinstance(refused.value, ValueError)
    assert refused.value.leg == 1 and refused.value.instant == 2.0 and refused.value.measure > refused.value.bound


def test_other_threads_run_while_it_computes(helix):
    s = ursula.read_scenario(helix)
    m = s.motion(np.linspace(0, s.duration, 300000))
    thread = threading.Thread(target=s.inverse_dynamics, args=(m,))
    thread.start()
    turns = 0
    while thread.is_alive():
        turns += 1
    assert turns > 100, "the lock was held"


def test_a_machine_has_its_numbers_merged(helix):
    s = ursula.read_scenario(helix)
    document = s.to_dict()["manipulator"]
    assert len(s.legs) == 6 and s.platform.mass == document["platform"]["mass"] > 0
    np.testing.assert_array_equal(s.gravity, [0, 0, -9.81])
    for leg, own in zip(s.legs, document["leg"]):
        np.testing.assert_array_equal(leg.base_point, own["base_point"])
        assert leg.proximal.mass == document["leg_defaults"]["proximal"]["mass"] > 0
        assert leg.distal.inertia.shape == (3, 3) and leg.distal.inertia[0, 0] == document["leg_defaults"]["distal"]["inertia"][0]
        assert abs(np.linalg.norm(leg.base_axis) - 1) < 1e-15
        assert leg.actuated == ["phi"] and set(leg.friction) == {"phi", "psi", "theta"}
