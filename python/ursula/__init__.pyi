import os
from collections.abc import Callable, Sequence
from typing import Any, Literal, overload

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Verdict = Literal["pass", "fail", "inconclusive", "not_applicable"]

__version__: str

class ScenarioError(ValueError):
    """A scenario that cannot be read. The message gives file, line, column, the error and what was expected."""

class PoseError(ValueError):
    """A pose that the legs or loops cannot reach, or that is singular; all four are None for a mechanism."""

    leg: int | None  # 1 to 6
    instant: float | None  # s
    measure: float | None
    bound: float | None

class UndeterminedPose(ValueError):
    """Actuated coordinates that do not determine the platform's pose."""

class Motion:
    """Pose, twist and twist rate of the platform at N instants, in B, SI."""

    def __init__(
        self,
        t: npt.ArrayLike,
        p: npt.ArrayLike,
        q: npt.ArrayLike,
        v: npt.ArrayLike | None = None,
        w: npt.ArrayLike | None = None,
        a: npt.ArrayLike | None = None,
        alpha: npt.ArrayLike | None = None,
    ) -> None: ...
    @property
    def t(self) -> Array:
        """Instants, s: (N,)."""
    @property
    def p(self) -> Array:
        """Position of P in B, m: (N, 3)."""
    @property
    def Q(self) -> Array:
        """Orientation of M in B: (N, 3, 3)."""
    @property
    def q(self) -> Array:
        """The same as unit quaternions [w, x, y, z]: (N, 4)."""
    @property
    def v(self) -> Array:
        """Velocity of P in B, m/s: (N, 3)."""
    @property
    def w(self) -> Array:
        """Angular velocity in B, rad/s: (N, 3)."""
    @property
    def a(self) -> Array:
        """Acceleration of P in B, m/s²: (N, 3)."""
    @property
    def alpha(self) -> Array:
        """Angular acceleration in B, rad/s²: (N, 3)."""
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, row: int) -> Motion: ...
    @overload
    def __getitem__(self, rows: slice) -> Motion: ...

class MechanismMotion:
    """Motion of a mechanism's n motors and of its other joints at N instants."""

    @property
    def t(self) -> Array:
        """Instants, s: (N,)."""
    @property
    def q(self) -> Array:
        """Coordinates of the motors, rad or m: (N, n)."""
    @property
    def qdot(self) -> Array:
        """Their rates, rad/s or m/s: (N, n)."""
    @property
    def qddot(self) -> Array:
        """Their accelerations, rad/s² or m/s²: (N, n)."""
    @property
    def joints(self) -> dict[str, Array]:
        """Coordinates of all other joints by name and unit, "knee_rad", "slide_m", "ball_w": each (N,)."""
    @property
    def joint_rates(self) -> dict[str, Array]:
        """Their rates, by the same names: each (N,)."""
    @property
    def joint_accelerations(self) -> dict[str, Array]:
        """Their accelerations, by the same names: each (N,)."""
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, row: int) -> MechanismMotion: ...
    @overload
    def __getitem__(self, rows: slice) -> MechanismMotion: ...

class Body:
    """A body of a mechanism, at the pose of its model file."""

    @property
    def name(self) -> str: ...
    @property
    def mass(self) -> float:
        """kg."""
    @property
    def fixed(self) -> bool: ...
    @property
    def center_of_mass(self) -> Array:
        """Position in the world, m: (3,)."""
    @property
    def inertia(self) -> Array:
        """About the mass centre, in the world's axes, kg m²: (3, 3)."""

class MechanismScenario:
    """A machine with any closed loops, the motion of its motors and the settings of its validation."""

    @property
    def name(self) -> str: ...
    @property
    def file(self) -> os.PathLike[str]: ...
    @property
    def model(self) -> os.PathLike[str]:
        """The model file that it names."""
    @property
    def duration(self) -> float:
        """Duration of the motion, s."""
    @property
    def motors(self) -> list[str]:
        """The driven joints, in the order of efforts."""
    @property
    def bodies(self) -> list[Body]: ...
    @property
    def assumptions(self) -> list[str]:
        """What was assumed on reading the model."""
    def motion(self, t: npt.ArrayLike) -> MechanismMotion:
        """The commanded motion at t, s: (N,) or a number."""
    def inverse_dynamics(self, m: MechanismMotion) -> Array:
        """Efforts of the n motors, N m, or N if a motor slides: (N, n)."""
    def direct_dynamics(self, m: MechanismMotion, tau: npt.ArrayLike) -> Array:
        """Accelerations of the n motors under efforts tau, N m or N, (N, n): rad/s² or m/s², (N, n)."""
    def forward_dynamics(self, m: MechanismMotion, tau: npt.ArrayLike) -> Array:
        """The same as direct_dynamics."""
    def direct_kinematics(self, coordinates: npt.ArrayLike) -> MechanismMotion:
        """The assemblies for coordinates of the n motors, rad or m, (N, n), each continued from the one before, at rest."""
    def to_dict(self) -> dict[str, Any]:
        """The scenario's source as a dict; scenario(s.to_dict()) has the same numbers."""
    def to_toml(self) -> str:
        """The text of the scenario's source."""

class Pose:
    """One pose of the platform for given actuated coordinates."""

    @property
    def p(self) -> Array:
        """Position of P in B, m: (3,)."""
    @property
    def q(self) -> Array:
        """Orientation of M in B as a unit quaternion [w, x, y, z], w >= 0: (4,)."""
    @property
    def Q(self) -> Array:
        """The same as a matrix: (3, 3)."""
    @property
    def multiplicity(self) -> int: ...
    @property
    def residual(self) -> float:
        """Largest mismatch of the legs, m."""
    @property
    def assembles(self) -> bool: ...
    @property
    def front(self) -> bool: ...

class Scenario:
    """A machine, its commanded motion and the settings of its validation."""

    @property
    def name(self) -> str: ...
    @property
    def file(self) -> os.PathLike[str]: ...
    @property
    def assumptions(self) -> list[dict[str, Any]]:
        """The assumptions of import_model(): what, where, size, unit and warning of each, warnings first."""
    @property
    def duration(self) -> float:
        """Duration of the motion, s."""
    @property
    def legs(self) -> list[Any]:
        """Of each leg: kind, base_point, base_axis, platform_point, proximal and distal (length, mass, center_of_mass,
        off_line, inertia), knee, actuated, spin, friction, coulomb, rotor_inertia, smoothing_speed; SI."""
    @property
    def platform(self) -> Any:
        """mass, center_of_mass (3,) in M and inertia (3, 3) about it; SI."""
    @property
    def gravity(self) -> Array:
        """g in B, m/s²: (3,)."""
    def motion(self, t: npt.ArrayLike) -> Motion:
        """The commanded motion at t, s: (N,) or a number."""
    def inverse_dynamics(self, m: Motion, *, jobs: int = 0) -> Array:
        """Efforts of the motors, N m, or N if a motor slides: (N, 6)."""
    def forward_dynamics(self, m: Motion, tau: npt.ArrayLike, *, jobs: int = 0) -> tuple[Array, Array]:
        """(a, alpha) of the platform under efforts tau, N m or N, (N, 6): m/s² and rad/s², each (N, 3)."""
    def inverse_kinematics(self, m: Motion) -> dict[str, Array]:
        """phi, psi, theta, d, if the legs have them, with rates and accelerations, rad, m and s, each (N, number of legs)."""
    def effort_derivatives(self, m: Motion) -> dict[str, Array]:
        """Derivatives of inverse_dynamics by "orientation" (a turn in B), "p", "w", "v", "alpha", "a": each (N, 6, 3)."""
    def parameter_derivatives(self, m: Motion) -> tuple[list[str], Array]:
        """(names, derivatives) by every number of the machine: (N, 6, number of names)."""
    def regressor(self, m: Motion) -> tuple[list[str], Array, Array]:
        """(names, values, Y): Y @ values is inverse_dynamics without the load; Y is (N, 6, number of names)."""
    def direct_kinematics(self, coordinates: npt.ArrayLike) -> list[Pose]:
        """Every real pose for six angles of URS legs, rad, or six lengths of UPS legs, m."""
    def to_dict(self) -> dict[str, Any]:
        """The source of the scenario as a dict."""
    def to_toml(self) -> str:
        """The text of the scenario's source."""

class Check:
    """One judged comparison; it passes exactly if value <= limit."""

    @property
    def name(self) -> str: ...
    @property
    def value(self) -> float: ...
    @property
    def limit(self) -> float: ...
    @property
    def unit(self) -> str: ...
    @property
    def verdict(self) -> Verdict: ...
    @property
    def basis(self) -> str:
        """The origin of the limit."""
    @property
    def why(self) -> str:
        """Details of the result."""
    @property
    def reason(self) -> str: ...

class Finding:
    """A fact of a validation that is not judged."""

    @property
    def name(self) -> str: ...
    @property
    def value(self) -> float | None:
        """In `unit`; None for a fact that is no number."""
    @property
    def uncertainty(self) -> float | None: ...
    @property
    def unit(self) -> str: ...
    @property
    def t(self) -> float | None:
        """The instant, s."""
    @property
    def leg(self) -> int | None:
        """From 1."""
    @property
    def text(self) -> str:
        """The fact in words."""

class Cause:
    """One cause of wrong efforts; fields that do not apply are None."""

    @property
    def kind(self) -> str:
        """As in summary.json: "parameter", "frame", "missing_term", …"""
    @property
    def explained(self) -> float:
        """Share of the deviation's square, 0 to 1."""
    @property
    def term(self) -> str | None: ...
    @property
    def body(self) -> str | None: ...
    @property
    def joint(self) -> str | None: ...
    @property
    def parameter(self) -> str | None:
        """Path in the scenario."""
    @property
    def unit(self) -> str | None: ...
    @property
    def leg(self) -> int | None: ...
    @property
    def motor(self) -> int | None: ...
    @property
    def legs(self) -> list[int] | None: ...
    @property
    def signs(self) -> list[int] | None:
        """Of an order: 1, or -1 for a column with the wrong sign."""
    @property
    def expected(self) -> float | None: ...
    @property
    def found(self) -> float | None: ...
    @property
    def uncertainty(self) -> float | None: ...
    @property
    def from_s(self) -> float | None: ...
    @property
    def to_s(self) -> float | None: ...

class Deviation:
    """The largest deviation of the efforts under test from the expected ones."""

    @property
    def largest(self) -> float:
        """In `unit`."""
    @property
    def unit(self) -> str: ...
    @property
    def t(self) -> float:
        """When, s."""
    @property
    def where(self) -> str:
        """The leg or the motor."""
    @property
    def largest_effort(self) -> float: ...
    @property
    def relative(self) -> float: ...
    @property
    def smallest_rtol(self) -> float: ...
    @property
    def drift(self) -> float:
        """m; NaN if unknown."""
    @property
    def allowed(self) -> float: ...

class ReplayError:
    """The sources of the judged replay's deviation from the path, m."""

    @property
    def dominant(self) -> str: ...
    @property
    def t(self) -> float:
        """s."""
    @property
    def observed(self) -> float: ...
    @property
    def rounding(self) -> float: ...
    @property
    def integration(self) -> float: ...
    @property
    def closure(self) -> float: ...
    @property
    def model(self) -> float: ...
    @property
    def unexplained(self) -> float: ...
    @property
    def uncertainty(self) -> float: ...
    @property
    def amplification(self) -> float: ...

class Result:
    """The result of one validation."""

    @property
    def scenario(self) -> str: ...
    @property
    def verdict(self) -> Literal["pass", "fail", "inconclusive"]: ...
    @property
    def reason(self) -> str: ...
    @property
    def checks(self) -> list[Check]: ...
    @property
    def findings(self) -> list[Finding]: ...
    @property
    def deviation(self) -> Deviation | None: ...
    @property
    def size(self) -> str | None:
        """"rounding", "modelling" or "wrong"; None if no effort is wrong. `summary["size"]` has the numbers."""
    @property
    def remedy(self) -> str:
        """A change of the scenario with which the efforts are right, in words; else empty."""
    @property
    def cause(self) -> Cause | None: ...
    @property
    def causes(self) -> list[Cause]: ...
    @property
    def causes_together(self) -> list[Cause]: ...
    @property
    def terms(self) -> dict[str, float]: ...
    @property
    def replay_error(self) -> ReplayError | None: ...
    @property
    def timeseries(self) -> dict[str, Array]: ...
    @property
    def summary(self) -> dict[str, Any]: ...
    @property
    def sentence(self) -> str:
        """What was found, in the words of the report's head."""
    def show(self, height: int = 900) -> Any:
        """Shows the report: in a notebook below the cell, elsewhere in the browser."""
    def plot(self) -> Any:
        """Efforts and their error over time: a figure of Matplotlib, which has to be installed."""
    def write(self, dir: str | os.PathLike[str]) -> None:
        """Writes summary.json, timeseries.csv, report.html and junit.xml into a folder."""

class Simulation:
    """The motion that efforts produce."""

    @property
    def motion(self) -> Any:
        """A Motion of the platform at the instants reached, or a MechanismMotion."""
    @property
    def tau(self) -> Array:
        """Efforts at the same instants, N m or N: (N, 6), or (N, n)."""
    @property
    def gave_up(self) -> str | None:
        """The reason why the last instant was not reached."""

class Channel:
    """One channel of a comparison."""

    @property
    def name(self) -> str: ...
    @property
    def scale(self) -> float: ...
    @property
    def tolerance(self) -> float: ...
    @property
    def max_error(self) -> float: ...
    @property
    def max_at(self) -> float: ...
    @property
    def rms_error(self) -> float: ...
    @property
    def final_error(self) -> float: ...
    @property
    def outside(self) -> float: ...
    @property
    def interpolation(self) -> float: ...
    @property
    def verdict(self) -> Literal["pass", "fail", "inconclusive"]: ...

class Comparison:
    """Two histories channel by channel."""

    @property
    def verdict(self) -> Literal["pass", "fail", "inconclusive"]: ...
    @property
    def channels(self) -> list[Channel]: ...
    @property
    def only_in_reference(self) -> list[str]: ...
    @property
    def only_in_test(self) -> list[str]: ...
    @property
    def instants(self) -> int: ...
    @property
    def interpolated(self) -> int: ...
    @property
    def left_out(self) -> int: ...
    @property
    def skipped(self) -> int: ...

History = Result | dict[str, npt.ArrayLike] | str | os.PathLike[str]
Axis = float | tuple[float, float, int] | None

class Checked(list[str]):
    """Warnings, and the mistakes that the scenario cannot show."""
    blind: list[dict[str, Any]] | None

def check(s: Scenario | MechanismScenario) -> Checked:
    """Returns warnings of values that are valid but unusual, and in `blind` the mistakes that cannot show."""

def compare(
    reference: History,
    test: History,
    *,
    tolerance: float = 1e-9,
    time_tolerance: float = 0.0,
    interpolate: bool | None = None,
    columns: list[str] = ...,
) -> Comparison:
    """Compares two histories channel by channel."""

def map(
    s: Scenario,
    *,
    x: Axis = None,
    y: Axis = None,
    z: Axis = None,
    roll: Axis = None,
    pitch: Axis = None,
    yaw: Axis = None,
    at: float = 0.0,
    jobs: int = 0,
) -> dict[str, Array]:
    """Maps reach, condition number, leg margins and largest static effort over a grid of poses."""

class Identified:
    """The comparison of measured efforts with the model; identify makes it."""

    verdict: str
    sentence: str
    cause: dict[str, Any] | None
    causes: list[dict[str, Any]]
    findings: list[dict[str, Any]]
    delay: dict[str, Any]
    motors: list[dict[str, Any]]
    combinations: list[dict[str, Any]]
    parameters: list[dict[str, Any]]
    summary: dict[str, Any]
    efforts: dict[str, Array]
    spectra: dict[str, Array]
    scenario_text: str
    def write(self, folder: str | os.PathLike[str]) -> None: ...

def identify(
    s: Scenario,
    measured: str | os.PathLike[str] | None = None,
    *,
    t: npt.ArrayLike | None = None,
    motion: npt.ArrayLike | None = None,
    efforts: npt.ArrayLike | None = None,
    map: Sequence[str] = (),
    constants: Sequence[float] = (),
    prior: bool = False,
) -> Identified:
    """Measured efforts against the model: a CSV file, or arrays."""

def excite(s: Scenario, *, period: float = 0.0, harmonics: int = 5, tries: int = 600, seed: int = 1) -> str:
    """A periodic motion that shows the machine's numbers, as the text of a samples file."""

def simulate(
    s: Scenario | MechanismScenario,
    torques: npt.ArrayLike,
    t: npt.ArrayLike,
    *,
    engine: Literal["noc", "simbody"] = "simbody",
    time_limit: float | None = None,
) -> Simulation:
    """Computes the motion that efforts (N, 6), or (N, n) of a mechanism, at instants t (N,) produce."""

def read_scenario(path: str | os.PathLike[str]) -> Any:
    """Reads and checks a scenario file (TOML): a Scenario, or a MechanismScenario if it has [mechanism]."""

def scenario(dict_or_text: dict[str, Any] | str, *, folder: str | os.PathLike[str] | None = None) -> Any:
    """Makes a scenario, as read_scenario does, from a dict or from text in TOML; relative paths start at `folder`, by default the current one."""

def import_model(
    path: str | os.PathLike[str],
    *,
    base: str = "",
    platform: str = "",
    actuated: Sequence[str] = ...,
    close: Sequence[str] = ...,
    tolerance: float = 1e-5,
    lump: float = 1e-3,
    leave_out: Sequence[str] = ...,
    key: str = "",
) -> Scenario:
    """Makes a scenario from a model in SDF, MJCF or URDF; `assumptions` lists the assumptions made."""

def validate(
    s: Scenario | MechanismScenario | str | os.PathLike[str],
    solver: Callable[[Any], npt.ArrayLike] | None = None,
    *,
    torques: npt.ArrayLike | None = None,
    t: npt.ArrayLike | None = None,
    rtol: float | str | None = None,
    atol: float | None = None,
    name: str | None = None,
    any_tolerance: bool = False,
    time_limit: float | None = None,
    thorough: bool = False,
    quick: bool = False,
    progress: Callable[[float, str], object] | bool | None = None,
    accelerations: Callable[[Any, Any], Any] | None = None,
) -> Result:
    """Validates a scenario, or that of a path, with this program's solver or with `solver`.

    The solver turns a Motion of N instants into efforts (N, 6), or a MechanismMotion into (N, n), N m or N. `accelerations` turns a
    motion and efforts into the platform's (a, alpha), (N, 3) each, or into the motors' (N, n).
    """
