"""Validates the dynamics of six-dof parallel manipulators and of any mechanism with closed loops.

NumPy in and out; rows are instants; SI units; frames: B is the base's, M the platform's.

    s = ursula.read_scenario("scenarios/paper-helix.toml")
    m = s.motion(numpy.linspace(0, s.duration, 301))
    tau = s.inverse_dynamics(m)                    # (301, 6), N m
    r = ursula.validate(s, solver=my_torques)      # my_torques(m) -> (N, 6)
    print(r.verdict, r.reason)

A scenario with [mechanism] is a MechanismScenario: its n motors are s.motors, a motion has m.q, m.qdot, m.qddot and m.joints, and
efforts are (N, n).
"""

try:
    import numpy as _numpy  # noqa: F401
except ImportError as _error:
    raise ImportError("ursula needs NumPy: pip install numpy, or apt install python3-numpy") from _error

from . import _errors, _notebook, _progress
from ._checked import Checked
from ._identify import Identified, identify
from ._ursula import (
    Body,
    Cause,
    Channel,
    Check,
    Comparison,
    Deviation,
    Finding,
    MechanismMotion,
    MechanismScenario,
    Motion,
    Pose,
    PoseError,
    ReplayError,
    Result,
    Scenario,
    ScenarioError,
    Simulation,
    UndeterminedPose,
    __version__,
    check,
    compare,
    excite,
    import_model,
    map,
    read_scenario,
    scenario,
    simulate,
    validate,
)

__all__ = [
    "Body",
    "Cause",
    "Channel",
    "Check",
    "Checked",
    "Comparison",
    "Deviation",
    "Finding",
    "Identified",
    "MechanismMotion",
    "MechanismScenario",
    "Motion",
    "Pose",
    "PoseError",
    "ReplayError",
    "Result",
    "Scenario",
    "ScenarioError",
    "Simulation",
    "UndeterminedPose",
    "__version__",
    "check",
    "compare",
    "excite",
    "identify",
    "import_model",
    "map",
    "read_scenario",
    "scenario",
    "simulate",
    "validate",
]

validate = _progress.with_bar(validate)
Result.plot = _notebook.plot
Result.show = _notebook.show
Result._repr_html_ = _notebook.html

_classes = (Body, Cause, Channel, Check, Comparison, Deviation, Finding, Identified, MechanismMotion, MechanismScenario, Motion, Pose,
            PoseError, ReplayError, Result, Scenario, ScenarioError, Simulation, UndeterminedPose)


def _reduced(self, protocol):
    # For protocols 0 and 1, copyreg makes an object of pybind11's own base class, which aborts.
    return object.__reduce_ex__(self, max(protocol, 2))


for _each in _classes:
    _each.__module__ = __name__
    _each.__reduce_ex__ = _reduced
identify.__module__ = Checked.__module__ = __name__
_errors.put_in_words(_classes)
for _each in (check, compare, excite, import_model, map, read_scenario, scenario, simulate, validate):
    globals()[_each.__name__] = _errors.in_words(_each, _each.__name__)
del _each, _classes
