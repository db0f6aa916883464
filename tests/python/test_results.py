"""What a result holds beside its verdict, and what a notebook shows of it."""

import functools
import importlib.util
import pickle
import sys

import numpy as np
import pytest

import ursula


@functools.lru_cache(maxsize=None)
def judged_once(scenario, factor):
    s = ursula.scenario(scenario)
    return ursula.validate(s, lambda m: factor * s.inverse_dynamics(m), name="mine")


def judged(quick, factor):
    return judged_once(quick.read_text(), factor)


def test_findings_are_those_of_the_summary(quick):
    r = judged(quick, 1.01)
    found = {each.name: each.text for each in r.findings}
    assert found and found == r.summary["findings"]
    acceleration = next(each for each in r.findings if each.name == "largest platform acceleration")
    assert acceleration.value > 0 and acceleration.unit == "m/s^2" and acceleration.t is None
    sine = next(each for each in r.findings if each.name == "smallest |sin theta|")
    assert 0 < sine.value < 1 and 1 <= sine.leg <= 6 and 0 <= sine.t <= 3
    assert next(each for each in r.findings if each.name == "dominant error").value is None
    again = pickle.loads(pickle.dumps(r.findings[0]))
    assert (again.name, again.text) == (r.findings[0].name, r.findings[0].text) and again.name in repr(again)


@pytest.mark.parametrize("factor", [1.01, 1 + 1e-6])
def test_the_deviation_has_fields(quick, factor):
    r = judged(quick, factor)
    found = r.deviation
    assert r.verdict == "fail" and found.unit == "N m" and found.where.startswith("leg ")
    assert found.relative == pytest.approx(factor - 1, rel=1e-6)
    assert found.largest == pytest.approx(found.relative * found.largest_effort, rel=1e-12)
    assert 0 <= found.t <= 3 and found.allowed == 0
    assert pickle.loads(pickle.dumps(found)).largest == found.largest


def test_the_smallest_tolerance_that_would_pass_passes(quick):
    s, smallest = ursula.read_scenario(quick), judged(quick, 1 + 1e-6).deviation.smallest_rtol
    for rtol, verdict in ((1.01 * smallest, "pass"), (0.99 * smallest, "fail")):
        assert ursula.validate(s, lambda m: (1 + 1e-6) * s.inverse_dynamics(m), rtol=rtol).verdict == verdict


def test_a_solver_gets_a_cause(quick):
    s = ursula.read_scenario(quick)
    heavy = s.to_dict()
    heavy["manipulator"]["platform"]["mass"] *= 1.01
    wrong = ursula.scenario(heavy)
    r = ursula.validate(s, wrong.inverse_dynamics, name="mine")
    cause = r.cause
    assert cause.kind == "parameter" and cause.parameter == "manipulator.platform.mass" and cause.body == "platform"
    assert cause.expected == 500 and cause.found == pytest.approx(505, rel=1e-9) and cause.unit == "kg"
    assert repr(cause) == "<ursula.Cause parameter manipulator.platform.mass>"
    assert cause.explained > 1 - 1e-9 and cause.leg is None and cause.legs is None
    assert r.summary["cause"]["found"] == cause.found and r.summary["causes"] == []
    assert {each["term"]: each["error"] for each in r.summary["terms"]} == r.terms
    assert 1e-3 < r.terms["statics"] < 0.1 and r.terms["repeat"] == 0 and r.terms["angular_velocity"] < 0.1
    again = pickle.loads(pickle.dumps(r))
    assert again.cause.found == cause.found and again.terms == r.terms


def test_where_no_cause_is_sure_none_is_named(quick):
    s = ursula.read_scenario(quick)
    m = s.motion(np.linspace(0, s.duration, 61))
    noise = ursula.validate(s, torques=s.inverse_dynamics(m) * (1 + 1e-3 * np.sin(1e6 * m.t))[:, None], t=m.t)
    assert noise.verdict == "fail" and noise.cause is None and noise.summary["cause"] is None
    right = judged(quick, 1)
    assert right.verdict == "pass" and right.cause is None and right.causes == [] and right.terms == {}


def test_the_replays_error_has_sources(quick):
    found = judged(quick, 1).replay_error
    assert found.dominant in ("model", "integration", "rounding", "closure", "amplification", "unexplained")
    parts = [found.rounding, found.integration, found.closure, found.model]
    assert 0 < found.observed < 1e-6 and all(0 <= each < 1e-6 for each in parts) and found.amplification >= 1
    assert pickle.loads(pickle.dumps(found)).observed == found.observed


def test_what_was_not_reached_is_none(quick):
    s = ursula.read_scenario(quick)
    unnamed = ursula.validate(s, lambda m: s.inverse_dynamics(m), time_limit=1e-9)
    assert unnamed.summary["provenance"]["subject"] == "your function"
    r = ursula.validate(s, time_limit=1e-9)
    assert r.deviation is None and r.replay_error is None
    if importlib.util.find_spec("matplotlib"):
        with pytest.raises(ValueError, match="no instant was computed"):
            r.plot()


def test_printed_it_is_what_the_terminal_prints(quick):
    wrong, right = judged(quick, 1.01), judged(quick, 1)
    assert str(wrong).startswith("paper-helix: fail\nverdict: fail — ") and "every torque scaled by 1.01" in str(wrong)
    assert str(right).startswith("paper-helix: pass\nverdict: pass — ")


def test_the_report_is_shown_in_the_browser(quick, monkeypatch):
    import pathlib
    import urllib.parse
    import webbrowser
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    judged(quick, 1.01).show()
    page = pathlib.Path(urllib.parse.unquote(urllib.parse.urlsplit(opened[0]).path))
    assert "every torque scaled by 1.01" in page.read_text(encoding="utf-8")


def test_a_notebook_shows_the_verdict(quick):
    wrong, right = judged(quick, 1.01)._repr_html_(), judged(quick, 1)._repr_html_()
    assert "every torque scaled by 1.01" in wrong.split("<table>")[0]
    assert ">fail</b>" in wrong and "torque.pointwise" in wrong and ">fail</b>" not in right
    named = ursula.scenario(quick.read_text().replace('name = "paper-helix"', 'name = "a-b"'))
    assert "<b>a-b</b>" in ursula.validate(named, time_limit=1e-9)._repr_html_()


def test_plot_needs_matplotlib(quick, monkeypatch):
    r = judged(quick, 1.01)
    if importlib.util.find_spec("matplotlib"):
        above, below = r.plot().axes
        assert len(above.lines) == 6 and len(below.lines) == 2
        assert np.array_equal(above.lines[2].get_ydata(), r.timeseries["tau_3_Nm"])
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ImportError, match="plot.. draws with Matplotlib, which is not installed"):
        r.plot()
