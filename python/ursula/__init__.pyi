import os
from collections.abc import Callable
from typing import Any, Literal, overload

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Verdict = Literal["pass", "fail", "inconclusive", "not_applicable"]

__version__: str

class ScenarioError(ValueError):
    """A scenario that cannot be read: file, line, column, what, and what was expected."""

class PoseError(ValueError):
    """A pose that the legs cannot take, or that is singular."""

    leg: int | None  # 1 to 6
    instant: float  # s
    measure: float
    bound: float

class UndeterminedPose(ValueError):
    """Actuated angles that do not determine the platform's pose."""

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

class Pose:
    """One pose of the platform for given actuated angles."""

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
    """A machine, what it is asked to do, and how that is judged."""

    @property
    def name(self) -> str: ...
    @property
    def file(self) -> os.PathLike[str]: ...
    @property
    def duration(self) -> float:
        """Of the motion, s."""
    def motion(self, t: npt.ArrayLike) -> Motion:
        """The commanded motion at t, s: (N,) or a number."""
    def inverse_dynamics(self, m: Motion, *, jobs: int = 0) -> Array:
        """Efforts of the motors, N m, or N where a motor slides: (N, 6)."""
    def forward_dynamics(self, m: Motion, tau: npt.ArrayLike, *, jobs: int = 0) -> tuple[Array, Array]:
        """(a, alpha) of the platform under efforts tau, N m or N, (N, 6): m/s² and rad/s², each (N, 3)."""
    def inverse_kinematics(self, m: Motion) -> dict[str, Array]:
        """phi, psi, theta, d, those that legs have, with rates and accelerations, rad, m and s, each (N, number of legs)."""
    def effort_derivatives(self, m: Motion) -> dict[str, Array]:
        """Of inverse_dynamics by "orientation" (a turn in B), "p", "w", "v", "alpha", "a": each (N, 6, 3)."""
    def parameter_derivatives(self, m: Motion) -> tuple[list[str], Array]:
        """(names, derivatives) by every number of the machine: (N, 6, number of names)."""
    def regressor(self, m: Motion) -> tuple[list[str], Array, Array]:
        """(names, values, Y): Y @ values is inverse_dynamics without the load; Y is (N, 6, number of names)."""
    def direct_kinematics(self, phi: npt.ArrayLike) -> list[Pose]:
        """Every real pose for six actuated angles of URS legs, rad."""
    def to_dict(self) -> dict[str, Any]:
        """What it was read from, as a dict."""
    def to_toml(self) -> str:
        """The text that it was read from."""

class Check:
    """One statement that was judged: it passes exactly if value <= limit."""

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
        """Where the limit comes from."""
    @property
    def why(self) -> str:
        """What was found."""
    @property
    def reason(self) -> str: ...

class Result:
    """What one validation found."""

    @property
    def scenario(self) -> str: ...
    @property
    def verdict(self) -> Literal["pass", "fail", "inconclusive"]: ...
    @property
    def reason(self) -> str: ...
    @property
    def checks(self) -> list[Check]: ...
    @property
    def findings(self) -> dict[str, str]: ...
    @property
    def timeseries(self) -> dict[str, Array]: ...
    @property
    def summary(self) -> dict[str, Any]: ...
    def write(self, dir: str | os.PathLike[str]) -> None:
        """Writes summary.json, timeseries.csv, report.html and junit.xml into a folder."""

def read_scenario(path: str | os.PathLike[str]) -> Scenario:
    """Reads and checks a scenario file (TOML)."""

def scenario(dict_or_text: dict[str, Any] | str, *, folder: str | os.PathLike[str] | None = None) -> Scenario:
    """A scenario of a dict or of text in TOML; relative paths are from `folder`, by default the current one."""

def validate(
    s: Scenario,
    solver: Callable[[Motion], npt.ArrayLike] | None = None,
    *,
    torques: npt.ArrayLike | None = None,
    t: npt.ArrayLike | None = None,
    rtol: float | None = None,
    atol: float | None = None,
    name: str | None = None,
    any_tolerance: bool = False,
    time_limit: float | None = None,
) -> Result:
    """The whole validation of a scenario, of this program's solver or of `solver`: Motion of N instants -> (N, 6), N m or N."""
