"""Wrong arguments are told in Python's own words: no text of the binding reaches its users."""

import inspect

import numpy as np
import pytest

import ursula

WRONG = (object(), "text", -1, 1.5, None, [], {}, [object()], np.zeros((2, 2)), b"bytes", lambda: 0)
BINDINGS_WORDS = ("incompatible", "Invoked with", "_ursula", "SupportsFloat", "std::", "pybind", "Unable to cast", "reference cast")


def told(call):
    """What a call raises; None where it is taken."""
    try:
        call()
    except Exception as error:  # of whatever type
        assert isinstance(error, (TypeError, ValueError, OSError, IndexError)), repr(error)
        return str(error)
    return None


def refuse_bindings_words(said, place):
    for words in BINDINGS_WORDS:
        assert words not in said, (place, said)


def made(quick):
    s = ursula.read_scenario(quick)
    m = s.motion([0.0, 1.0])
    r = ursula.validate(s, solver=lambda m: np.zeros((len(m.t), 6)), time_limit=1e-3)
    return [s, m, r, r.checks[0], s.direct_kinematics(s.inverse_kinematics(m)["phi"][0])[0]]


def calls(quick):
    """Every function and method, by name."""
    out = {name: getattr(ursula, name) for name in ursula.__all__
           if not inspect.isclass(getattr(ursula, name)) and callable(getattr(ursula, name))}
    out["Motion"] = ursula.Motion
    for each in made(quick):
        for name in dir(each):
            takes = name == "__getitem__" or not name.startswith("_")
            if takes and name not in ("plot", "write") and callable(getattr(each, name)):
                out[f"{type(each).__name__}.{name}"] = getattr(each, name)
    return out


def test_no_call_shows_the_bindings_words(quick, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    refused = 0
    for name, call in calls(quick).items():
        for wrong in WRONG:
            for arguments, named in (((wrong,), {}), ((wrong, wrong, wrong), {}), ((), {"no_such": wrong}), ((), {})):
                said = told(lambda call=call, arguments=arguments, named=named: call(*arguments, **named))
                if said is not None:
                    refused += 1
                    refuse_bindings_words(said, (name, arguments, named))
    assert refused > 300


def test_no_keyword_shows_the_bindings_words(quick):
    s = ursula.read_scenario(quick)
    for call, names in ((ursula.validate, ("solver", "torques", "t", "rtol", "atol", "name", "any_tolerance", "time_limit")),
                        (ursula.map, ("x", "y", "z", "roll", "pitch", "yaw", "at", "jobs")),
                        (ursula.simulate, ("torques", "t", "engine", "time_limit")),
                        (ursula.import_model, ("base", "platform", "actuated", "close", "tolerance", "lump"))):
        for name in names:
            for wrong in (object(), [object()], b"bytes"):
                said = told(lambda call=call, name=name, wrong=wrong: call(s, **{name: wrong}))
                assert said is not None or (call, name) == (ursula.validate, "name"), (call, name, wrong)
                refuse_bindings_words(said or "", (call.__name__, name, wrong))


@pytest.mark.parametrize("call, words", [
    (lambda s: ursula.validate(), "validate: missing a required argument: 's'"),
    (lambda s: ursula.validate(7), "validate: s is 7 of type int, expected ursula.Scenario, ursula.MechanismScenario or a path"),
    (lambda s: ursula.validate(s, rtol=[1]), r"validate: rtol is \[1\] of type list, expected a number, a share such as '0.1%' or None"),
    (lambda s: ursula.validate(s, solver="python3 mine.py"),
     "solver is 'python3 mine.py' of type str, expected a function of a Motion; a command is for `ursula validate` in a terminal"),
    (lambda s: s.inverse_dynamics(np.zeros((20, 6))), "m is a value of type ndarray, expected ursula.Motion"),
    (lambda s: ursula.validate(s, rtl=1e-3), "validate: got an unexpected keyword argument 'rtl'"),
    (lambda s: ursula.read_scenario(3), "read_scenario: path is 3 of type int, expected a path"),
    (lambda s: ursula.import_model("a.sdf", actuated=[1]), r"import_model: actuated is \[1\] of type list, expected a list, each a string"),
    (lambda s: s.inverse_dynamics([1, 2]), r"Scenario.inverse_dynamics: m is \[1, 2\] of type list, expected ursula.Motion"),
    (lambda s: s.motion(), "Scenario.motion: missing a required argument: 't'"),
    (lambda s: s.inverse_dynamics(s.motion(0), 2), "Scenario.inverse_dynamics: too many positional arguments"),
    (lambda s: s.motion(0)["p"], "Motion.__getitem__: 'p' of type str, expected an integer or a slice"),
    (lambda s: ursula.Scenario(), r"^Scenario: results of functions are such objects, no call makes one; help\(ursula.Scenario\)"),
    (lambda s: ursula.identify(s), "identify: t is missing, expected an array of numbers, or the path of a file as measured"),
    (lambda s: ursula.Motion(1), "Motion: missing a required argument: 'p'"),
])
def test_the_argument_is_named(quick, call, words):
    with pytest.raises(TypeError, match=words):
        call(ursula.read_scenario(quick))


@pytest.mark.parametrize("call, words", [
    (lambda s, t, tau: ursula.validate(s, torques=tau, t=t[::-1]), r"^t\[1\] = \S+ comes after \S+ of t\[0\], expected increasing instants$"),
    (lambda s, t, tau: ursula.validate(s, torques=tau, t=np.r_[t[:-1], t[-2]]), r"^t\[5\] = \S+ repeats t\[4\], expected"),
    (lambda s, t, tau: ursula.validate(s, torques=tau, t=t + 9), r"^t\[0\] = 9 lies outside of the motion, expected 0 to"),
    (lambda s, t, tau: ursula.validate(s, torques=tau[:0], t=t[:0]), "^torques: no rows, expected at least one$"),
    (lambda s, t, tau: ursula.validate(s, rtol="a lot"), "^rtol is 'a lot', expected a number or a share such as '0.1%'$"),
    (lambda s, t, tau: ursula.validate(s, torques=tau, t=t, rtol=-1), "^rtol is -1.0, expected a positive number$"),
    (lambda s, t, tau: ursula.simulate(s, torques=tau, t=t[::-1]), r"^t\[1\] = \S+ comes after \S+ of t\[0\]"),
    (lambda s, t, tau: ursula.compare({"t_s": t[::-1]}, {"t_s": t}), r"^reference\['t_s'\]\[1\] does not increase here"),
    (lambda s, t, tau: ursula.compare({"t": t}, {"t_s": t}), "^reference: no 't_s', expected the instants, s$"),
    (lambda s, t, tau: ursula.compare({"t_s": t}, {"t_s": t}, columns=["x"]), "^columns x: neither side has such a column$"),
    (lambda s, t, tau: ursula.map(s, x=(0, 1)), r"^x is \(0, 1\), expected a number or \(from, to, count\)$"),
    (lambda s, t, tau: ursula.map(s, x="a"), r"^x is 'a', expected a number or \(from, to, count\)$"),
    (lambda s, t, tau: ursula.excite(s, harmonics=0), "^excite: expected a period and a seed of 0 or more, harmonics and tries of 1"),
])
def test_wrong_arrays_are_told_by_index_not_by_line(quick, call, words):
    s = ursula.read_scenario(quick)
    t = np.linspace(0, s.duration, 6)
    with pytest.raises(ValueError, match=words):
        call(s, t, s.inverse_dynamics(s.motion(t)))


def test_an_error_within_a_solver_is_its_own(quick):
    def solver(m):
        raise TypeError("mine: incompatible with this")

    with pytest.raises(TypeError, match="^mine: incompatible with this$"):
        ursula.validate(ursula.read_scenario(quick), solver=solver)


def test_a_scenario_that_is_wrong_is_shown_at_the_place():
    with pytest.raises(ursula.ScenarioError) as refused:
        ursula.scenario("name = \"a\"\nmass = [1,,2]\n")
    assert str(refused.value).splitlines()[-2:] == ["   2 | mass = [1,,2]", "     |           ^"]


def test_all_that_is_wrong_in_a_scenario_is_shown():
    with pytest.raises(ursula.ScenarioError) as refused:
        ursula.scenario("name = \"a\"\nweight = 2\n[manipulator]\ngravity = 9.81\n")
    said = str(refused.value)
    assert said.startswith("<text>:2:1: error: unknown key 'weight'") and "\n<text>:4:11: error: manipulator.gravity: a float" in said
    assert said.count("^") == 2


def test_classes_have_the_modules_name(quick):
    with pytest.raises(AttributeError, match="'ursula.Scenario' object has no attribute 'duratoin'"):
        ursula.read_scenario(quick).duratoin
