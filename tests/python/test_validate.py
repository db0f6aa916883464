"""validate() with this program's solver and with functions of one's own."""

import filecmp
import json
import subprocess
import sys
import threading

import numpy as np
import pytest

import ursula

FILES = ("summary.json", "timeseries.csv", "report.html")  # junit.xml has times


def test_the_result_and_its_files_are_the_programs(program, quick, tmp_path):
    assert program("validate", quick, "--out", tmp_path / "program").returncode == 0
    s = ursula.read_scenario(quick)
    r = ursula.validate(s)
    assert ursula.validate(s, time_limit=1e8).summary == r.summary, "a limit that is not reached changes nothing"
    r.write(tmp_path / "python")
    match, mismatch, errors = filecmp.cmpfiles(tmp_path / "program", tmp_path / "python", FILES, shallow=False)
    assert sorted(match) == sorted(FILES), (mismatch, errors)
    assert "<testsuite " in (tmp_path / "python" / "junit.xml").read_text()
    assert r.verdict == "pass" and r.summary == json.loads((tmp_path / "program" / "summary.json").read_text())
    by_name = {check["name"]: check for check in r.summary["checks"]}
    assert [check.name for check in r.checks] == list(by_name)
    for check in r.checks:
        assert check.verdict == by_name[check.name]["verdict"] and check.why == by_name[check.name]["why"]
        assert check.basis == by_name[check.name]["basis"] and check.unit == by_name[check.name]["unit"]
        if check.verdict == "pass":
            assert check.value <= check.limit and check.value == by_name[check.name]["value"]
    assert r.timeseries["t_s"].shape == (11,)


def test_a_right_solver_passes_and_is_asked_for_many_instants_at_once(quick):
    s, asked = ursula.read_scenario(quick), []

    def mine(m):
        asked.append(len(m))
        return s.inverse_dynamics(m)

    r = ursula.validate(s, solver=mine, name="mine")
    assert r.verdict == "pass", r.reason
    assert r.summary["provenance"]["subject"] == "mine"
    assert 11 in asked and max(asked) > 1000 and sum(asked) > 8 * len(asked)
    verdicts = {check.name: check.verdict for check in r.checks}
    for name in ("torque.pointwise", "torque.between", "replay.position", "integration.ladder", "feedback.torque"):
        assert verdicts[name] == "pass"
    for name in ("invariance.rotation", "kinematics.joint_angles", "direct.pointwise"):
        assert verdicts[name] == "not_applicable"


def test_a_slow_solver_is_asked_few_times_unless_thorough(quick):
    s, asked = ursula.read_scenario(quick), []

    def mine(m):
        asked.append(len(m))
        return 1.01 * s.inverse_dynamics(m)

    r = ursula.validate(s, mine)
    assert r.verdict == "fail" and r.cause.kind == "scale" and sum(asked) <= 2000
    assert "may be missed" in r.summary["findings"]["questions"]
    asked.clear()
    ursula.validate(s, lambda m: mine(m) / 1.01, thorough=True)
    assert sum(asked) > 10000
    asked.clear()
    r = ursula.validate(s, mine, quick=True)
    assert r.verdict == "fail" and sum(asked) < 11 + 130
    verdicts = {check.name: check.verdict for check in r.checks}
    assert verdicts["torque.pointwise"] == "fail" and verdicts["torque.between"] == verdicts["replay.position"] == "not_applicable"
    assert ursula.validate(s, quick=True).verdict == "pass"
    with pytest.raises(TypeError, match="thorough and quick are given"):
        ursula.validate(s, mine, thorough=True, quick=True)


def test_progress_is_told_and_its_exception_arrives(quick):
    s, told = ursula.read_scenario(quick), []
    ursula.validate(s, s.inverse_dynamics, progress=lambda share, now: told.append((share, now)))
    shares = [share for share, _ in told]
    assert len(shares) > 2 and shares == sorted(shares) and 0 < shares[0] and shares[-1] < 1
    assert {now for _, now in told} == {"asking the solver"}
    told.clear()
    ursula.validate(s, progress=lambda share, now: told.append((share, now)))
    assert len({now for _, now in told}) > 2

    def fails(share, now):
        raise Broken("told")

    with pytest.raises(Broken, match="told"):
        ursula.validate(s, progress=fails)
    with pytest.raises(Broken, match="told"):
        ursula.validate(s, s.inverse_dynamics, progress=fails)
    with pytest.raises(TypeError, match="progress is of type int, expected a function"):
        ursula.validate(s, progress=3)


def test_a_bar_is_shown_where_somebody_looks(quick, monkeypatch):
    written = []

    class Terminal:
        def isatty(self):
            return True

        def write(self, text):
            written.append(text)

        def flush(self):
            pass

    s = ursula.read_scenario(quick)
    monkeypatch.setattr(ursula._progress, "_FROM", 0.0)
    monkeypatch.setattr(sys, "stderr", Terminal())
    ursula.validate(s, s.inverse_dynamics, progress=False)
    assert written == []
    ursula.validate(s, s.inverse_dynamics)
    assert "asking the solver" in "".join(written) and written[-1].startswith("\r")


def test_a_simulator(quick):
    s, asked = ursula.read_scenario(quick), []

    def mine(m, tau, factor=1.0):
        assert tau.shape == (len(m), 6) and not m.a.any() and not m.alpha.any()
        asked.append(len(m))
        return s.forward_dynamics(m, factor * tau)

    r = ursula.validate(s, accelerations=mine)
    assert r.verdict == "pass", r.reason
    assert sum(asked) <= 2000 and r.summary["provenance"]["subject"] == "mine"
    assert {check.name: check.verdict for check in r.checks}["direct.off_path"] == "pass"
    r = ursula.validate(s, accelerations=lambda m, tau: mine(m, tau, 1.001))
    assert r.verdict == "fail" and r.cause.kind == "scale"
    assert ursula.validate(s, accelerations=lambda m, tau: mine(m, tau, 1.001), rtol="1%").verdict == "pass"

    def broken(m, tau):
        raise Broken("at once")

    with pytest.raises(Broken):
        ursula.validate(s, accelerations=broken)
    for answer, words in ((lambda m, tau: 3, r"expected a pair \(a, alpha\)"),
                          (lambda m, tau: (m.p, m.p[:, :2]), r"the simulator's answer to \d+ instants has shape"),
                          (lambda m, tau: (m.p, m.p * np.nan), "the simulator's acceleration 1 at t = 0.0 s is nan")):
        with pytest.raises(ValueError, match=words):
            ursula.validate(s, accelerations=answer)
    with pytest.raises(TypeError, match="accelerations and solver or torques are given"):
        ursula.validate(s, s.inverse_dynamics, accelerations=mine)


def test_a_wrong_solver_fails(quick):
    s = ursula.read_scenario(quick)
    r = ursula.validate(s, lambda m: (1 + 1e-11) * s.inverse_dynamics(m))
    assert r.verdict == "fail"
    assert "torque.pointwise" in [check.name for check in r.checks if check.verdict == "fail"]


def test_a_tolerance_of_ones_own(quick):
    s = ursula.read_scenario(quick)

    def off(m):
        return (1 + 1e-7) * s.inverse_dynamics(m)

    assert ursula.validate(s, off, rtol="1e-4%").verdict == "pass"
    assert ursula.validate(s, off, rtol="1e-10%").verdict == "fail"
    assert ursula.validate(s, off, atol=1e-4).verdict == "fail"
    with pytest.raises(ValueError, match="rtol is -1.0, expected a positive number"):
        ursula.validate(s, rtol=-1)


@pytest.mark.parametrize("answer, words", [
    (lambda m: np.zeros((len(m), 5)), r"to 11 instants has shape \(11, 5\), expected \(11, 6\)"),
    (lambda m: np.zeros((len(m) + 1, 6)), r"to 11 instants has shape \(12, 6\), expected \(11, 6\)"),
    (lambda m: np.where(np.arange(6) == 2, np.nan, np.ones((len(m), 6))), "effort 3 at t = 0.0 s is nan"),
    (lambda m: np.full((len(m), 6), -np.inf, np.float32), "effort 1 at t = 0.0 s is -inf"),
    (lambda m: None, "of type NoneType, expected an array of real numbers"),
    (lambda m: "torques", "of type str, expected an array of real numbers"),
    (lambda m: np.zeros((len(m), 6), complex), r"of type ndarray, expected an array of real numbers \(found complex128\)"),
    (lambda m: np.zeros((len(m), 6), "datetime64[s]"), r"expected an array of real numbers \(found datetime64\[s\]\)"),
    (lambda m: np.full((len(m), 6), "1"), r"expected an array of real numbers \(found text\)"),
    (lambda m: [[None] * 6] * len(m), r"expected an array of real numbers \(found objects\)"),
    (lambda m: np.ma.masked_all((len(m), 6)), r"expected an array of real numbers \(found a masked array\)"),
    (lambda m: [np.ma.masked_all(6)] * len(m), r"expected an array of real numbers \(found a masked array\)"),
    (lambda m: np.broadcast_to(0.0, (10**12, 6)), r"to 11 instants has shape \(1000000000000, 6\), expected \(11, 6\)"),
])
def test_what_is_no_answer_is_refused(quick, answer, words):
    with pytest.raises(ValueError, match=words):
        ursula.validate(ursula.read_scenario(quick), solver=answer)


def test_what_is_no_function_is_refused(quick):
    with pytest.raises(TypeError, match="solver is of type int, expected a function"):
        ursula.validate(ursula.read_scenario(quick), solver=3)


def test_an_answer_that_cannot_be_cast_raises_what_numpy_raises(quick):
    too_large = np.full((11, 6), np.finfo(np.longdouble).max)
    if too_large[0, 0] == np.finfo(float).max:
        pytest.skip("long double is double here")
    with np.errstate(over="raise"), pytest.raises(FloatingPointError):
        ursula.validate(ursula.read_scenario(quick), solver=lambda m: too_large)
    with pytest.raises(ValueError, match="effort 1 at t = 0.0 s is inf"), np.errstate(over="ignore"):
        ursula.validate(ursula.read_scenario(quick), solver=lambda m: too_large)


class Raising:
    """What gives NumPy an error in the place of numbers."""

    def __init__(self, error):
        self.error = error

    def __array__(self, *_, **__):
        raise self.error


@pytest.mark.parametrize("error", [MemoryError, KeyboardInterrupt, ZeroDivisionError])
def test_an_error_within_a_conversion_passes_as_it_is(quick, error):
    s = ursula.read_scenario(quick)
    for call in (lambda: s.motion(Raising(error)), lambda: ursula.Motion(0, Raising(error), [1, 0, 0, 0]),
                 lambda: ursula.validate(s, solver=lambda m: Raising(error))):
        with pytest.raises(error):
            call()


LONG = """
import os, signal, threading, ursula
s = ursula.read_scenario({file!r})
class Heard(Exception): pass
def hear(*_): raise Heard
if {own}: signal.signal(signal.SIGINT, hear)
threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    ursula.validate(s{more})
except Heard if {own} else KeyboardInterrupt:
    print("heard", os.listdir({folder!r}))
"""


@pytest.mark.parametrize("own, more", [(False, ""), (True, ""), (False, ", solver=lambda m: s.inverse_dynamics(m)")])
def test_a_signal_ends_what_takes_hours(helix, tmp_path, own, more):
    (tmp_path / "empty").mkdir()
    file = tmp_path / "long.toml"
    file.write_text(helix.read_text().replace("duration = 3.0", "duration = 7200.0"))
    code = LONG.format(file=str(file), own=own, more=more, folder=str(tmp_path / "empty"))
    run = subprocess.run([sys.executable, "-c", code], cwd=tmp_path / "empty", capture_output=True, text=True,
                         timeout=300, check=False)
    assert run.stdout == "heard []\n", run.stderr


def test_a_time_limit(quick):
    s = ursula.read_scenario(quick)
    r = ursula.validate(s, time_limit=1e-9)
    assert r.verdict == "inconclusive"
    assert "the time limit of 1e-09 s was reached" in [check.why for check in r.checks]
    for wrong in (0, -1, np.nan, np.inf):
        with pytest.raises(ValueError, match="time_limit is .*, expected a positive number"):
            ursula.validate(s, time_limit=wrong)


@pytest.mark.parametrize("folder, words", [
    ("", "cannot write '': an empty path, expected a folder"),
    ("n" * 300, "cannot write n+: File name too long"),
    ("file/below", "cannot write file/below: file is a file, expected a folder"),
])
def test_a_folder_that_cannot_be_written_is_an_os_error(quick, tmp_path, monkeypatch, folder, words):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("")
    before = sorted(tmp_path.iterdir())
    with pytest.raises(OSError, match=f"^{words}$"):
        ursula.validate(ursula.read_scenario(quick), time_limit=1e-9).write(folder)
    assert sorted(tmp_path.iterdir()) == before


class Broken(Exception):
    pass


@pytest.mark.parametrize("share", [0, 0.6, 0.95])
def test_an_exception_arrives_as_it_was_raised(quick, share):
    """Wherever in the validation it is raised: in its threads, within the integrators."""
    s, calls, most = ursula.read_scenario(quick), 0, int(share * 800)
    raised = Broken("at that call")

    def mine(m):
        nonlocal calls
        calls += 1
        if calls > most:
            raise raised
        return s.inverse_dynamics(m)

    with pytest.raises(Broken) as caught:
        ursula.validate(s, solver=mine, thorough=True)
    assert caught.value is raised
    assert calls == most + 1, "it was asked again after that"


def test_two_threads_at_once(quick):
    s, verdicts = ursula.read_scenario(quick), {}

    def judge(name, factor):
        try:
            verdicts[name] = ursula.validate(s, lambda m: factor * s.inverse_dynamics(m)).verdict
        except Broken as error:
            verdicts[name] = error

    threads = [threading.Thread(target=judge, args=each) for each in (("right", 1.0), ("wrong", 1.01))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert verdicts == {"right": "pass", "wrong": "fail"}


def exact(s, instants=301):
    m = s.motion(np.linspace(0, s.duration, instants))
    return m.t, s.inverse_dynamics(m)


def write_csv(path, t, tau):
    rows = [",".join(["t_s", *(f"tau_{i + 1}_Nm" for i in range(6))])]
    rows += [",".join(repr(float(each)) for each in (at, *row)) for at, row in zip(t, tau)]
    path.write_text("\n".join(rows) + "\n")


@pytest.mark.parametrize("rtol, verdict", [(None, "fail"), (0.02, "pass")])
def test_torques_of_ones_own_are_judged_as_the_programs_file(program, quick, tmp_path, rtol, verdict):
    s = ursula.read_scenario(quick)
    t, tau = exact(s)
    tau *= 1.01
    r = ursula.validate(s, torques=tau, t=t, rtol=rtol, name="mine.csv")
    assert r.verdict == verdict, r.reason
    write_csv(tmp_path / "mine.csv", t, tau)
    more = ["--rtol", rtol] if rtol else []
    program("validate", quick, "--torques", "mine.csv", "--out", "out", *more)
    assert r.summary == json.loads((tmp_path / "out" / "summary.json").read_text())


def test_rounded_torques_count_as_rounded(quick):
    s = ursula.read_scenario(quick)
    t, tau = exact(s)
    assert ursula.validate(s, torques=np.round(tau, 6), t=t).verdict != "fail"
    off = np.round(tau, 6)
    off[150, 2] += 1e-4
    assert ursula.validate(s, torques=off, t=t).verdict == "fail"


def test_a_time_limit_and_any_tolerance_hold_for_torques(quick):
    s = ursula.read_scenario(quick)
    t, tau = exact(s)
    assert ursula.validate(s, torques=tau, t=t, time_limit=1e-9).verdict == "inconclusive"
    with pytest.raises(ValueError, match="torques of zero|zero"):
        ursula.validate(s, torques=0 * tau, t=t, rtol=2.0)
    assert ursula.validate(s, torques=0 * tau, t=t, rtol=2.0, any_tolerance=True).verdict == "pass"
    with pytest.raises(ValueError, match="time_limit is .*, expected a positive number"):
        ursula.validate(s, torques=tau, t=t, time_limit=-1)


@pytest.mark.parametrize("error, words, change", [
    (TypeError, "torques are given without t", lambda t, tau: {"torques": tau}),
    (TypeError, "t is given without torques", lambda t, tau: {"t": t}),
    (TypeError, "solver and torques are given", lambda t, tau: {"torques": tau, "t": t, "solver": len}),
    (ValueError, r"torques: shape \(301, 5\), expected \(N, 6\)", lambda t, tau: {"torques": tau[:, :5], "t": t}),
    (ValueError, "torques: 300 rows, expected one for each of the 301", lambda t, tau: {"torques": tau[1:], "t": t}),
    (ValueError, r"torques\[0, 0\] is not finite", lambda t, tau: {"torques": tau * np.nan, "t": t}),
    (ValueError, "lies outside of the motion, expected 0 to 3 s; they look like milliseconds",
     lambda t, tau: {"torques": tau, "t": 1000 * t}),
    (ValueError, "expected increasing instants", lambda t, tau: {"torques": tau, "t": t[::-1]}),
    (ValueError, "torques: no rows, expected at least one", lambda t, tau: {"torques": tau[:0], "t": t[:0]}),
])
def test_torques_that_cannot_be_judged_are_refused(quick, error, words, change):
    s = ursula.read_scenario(quick)
    with pytest.raises(error, match=words):
        ursula.validate(s, **change(*exact(s)))
