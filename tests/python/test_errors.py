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
    (lambda s: ursula.validate("my.toml"), "validate: s is 'my.toml' of type str, expected ursula.Scenario"),
    (lambda s: ursula.validate(s, rtol="a lot"), "validate: rtol is 'a lot' of type str, expected a number, a share such as '0.1%', or None"),
    (lambda s: ursula.validate(s, rtol=[1]), r"validate: rtol is \[1\] of type list, expected a number, a share such as '0.1%' or None"),
    (lambda s: ursula.validate(s, solver="python3 mine.py"),
     "solver is 'python3 mine.py' of type str, expected a function of a Motion; `ursula validate --solver` takes a command"),
    (lambda s: s.inverse_dynamics(np.zeros((20, 6))), "m is a value of type ndarray, expected ursula.Motion"),
    (lambda s: ursula.validate(s, rtl=1e-3), "validate: got an unexpected keyword argument 'rtl'"),
    (lambda s: ursula.read_scenario(3), "read_scenario: path is 3 of type int, expected a path"),
    (lambda s: ursula.import_model("a.sdf", actuated=[1]), r"import_model: actuated is \[1\] of type list, expected a list, each a string"),
    (lambda s: s.inverse_dynamics([1, 2]), r"Scenario.inverse_dynamics: m is \[1, 2\] of type list, expected ursula.Motion"),
    (lambda s: s.motion(), "Scenario.motion: missing a required argument: 't'"),
    (lambda s: s.inverse_dynamics(s.motion(0), 2), "Scenario.inverse_dynamics: too many positional arguments"),
    (lambda s: s.motion(0)["p"], "Motion.__getitem__: 'p' of type str is none of what it takes"),
    (lambda s: ursula.Motion(1), "Motion: missing a required argument: 'p'"),
])
def test_the_argument_is_named(quick, call, words):
    with pytest.raises(TypeError, match=words):
        call(ursula.read_scenario(quick))


def test_an_error_within_a_solver_is_its_own(quick):
    def solver(m):
        raise TypeError("mine: incompatible with this")

    with pytest.raises(TypeError, match="^mine: incompatible with this$"):
        ursula.validate(ursula.read_scenario(quick), solver=solver)


def test_a_scenario_that_is_wrong_is_shown_at_the_place():
    with pytest.raises(ursula.ScenarioError) as refused:
        ursula.scenario("name = \"a\"\nmass = [1,,2]\n")
    assert str(refused.value).splitlines()[-2:] == ["   2 | mass = [1,,2]", "     |           ^"]
