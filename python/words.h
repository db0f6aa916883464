#pragma once

// The text of `help(ursula)`.

namespace ursula::python::words {

constexpr const char* mechanism_scenario =
    R"(A machine with any closed loops, the motion of its motors and the settings of its validation; read_scenario and
scenario make it of a file or text with [mechanism].)";

constexpr const char* mechanism_motion =
    R"(Motion of a mechanism's n motors and of its other joints at N instants; a MechanismScenario's motion() makes it.
Arrays are views that cannot be written to. m[k] and m[i:j] are motions, too.)";

constexpr const char* joints =
    R"(Coordinates of all joints that no motor drives, by the model's names and units: "knee_rad", "slide_m", each (N,).
A ball has a quaternion, "ball_w" to "ball_z".)";

constexpr const char* mechanism_at =
    R"(The commanded motion at t, s: (N,) or a number, in [0, duration]. It follows the loops from the assembly of the
model's pose. Raises ValueError for an instant outside or not finite, ScenarioError unless there are as many motors as
freedoms, and PoseError if the loops cannot follow.)";

constexpr const char* mechanism_inverse_dynamics =
    R"(Efforts of the n motors for a motion of N instants: (N, n), N m, or N for a motor that slides. Each is conjugate
to its motor's rate. `ursula inverse` writes the same numbers. Raises ValueError for a motion of another number of motors,
and PoseError as motion() does.)";

constexpr const char* mechanism_direct_dynamics =
    R"(Accelerations of the n motors under efforts tau, N m or N, (N, n), in the states of a motion of N instants:
(N, n), rad/s² or m/s². The motion's own accelerations are not read. Raises ValueError for other shapes, and PoseError
as motion() does.)";

constexpr const char* mechanism_direct_kinematics =
    R"(Computes the assemblies for coordinates of the n motors, rad or m, (N, n), as a MechanismMotion at rest, with t = 0.
Each row continues the assembly of the row before, the first that at the start of the motion. Raises ValueError for
other shapes, and PoseError as motion() does.)";

constexpr const char* body = "A body of a mechanism, at the pose of its model file.";

constexpr const char* module =
    R"(Validates the dynamics of six-dof parallel manipulators and of any mechanism with closed loops.

NumPy in and out; rows are instants; SI units; frames: B is the base's, M the platform's.)";

constexpr const char* motion = R"(Motion(t, p, q, v=None, w=None, a=None, alpha=None)

Pose, twist and twist rate of the platform at N instants. Arrays are views that cannot be written to.

t: instants, s, (N,) or a number. p: position of P in B, m, (N, 3). q: unit quaternions [w, x, y, z] of M in B,
(N, 4), normalised. v, w, a, alpha: velocity of P, m/s, angular velocity, rad/s, and their rates, in B, (N, 3);
zero if omitted. m[k] and m[i:j] are motions, too. Raises ValueError for other shapes and for values not finite.)";

constexpr const char* q =
    "Orientation of M in B as unit quaternions [w, x, y, z]: (N, 4). The first has w >= 0; the signs do not jump.";

constexpr const char* read_scenario =
    R"(Reads and checks a scenario file (TOML). Returns a Scenario, or a MechanismScenario if the file has [mechanism].
Raises ScenarioError, with file, line and column. Warns (UserWarning) of what check() lists, as scenario() and
import_model() do.)";

constexpr const char* scenario_of =
    R"(Makes a scenario, as read_scenario does, from a dict or from text in TOML, with the keys of a scenario's file. A
dict may contain arrays of NumPy and paths. folder: relative paths start there; default: the current folder. Raises
ScenarioError, with line and column for a text, and with the key for a dict, whose lines are those of its to_toml().)";

constexpr const char* import_model =
    R"(Makes a Scenario from a model in SDF, MJCF or URDF. base and platform: names of bodies, if the model has several
candidates. actuated: the joints that motors drive, if the file does not name them. close: pairs "A:B" of links
whose frames a ball joins. tolerance (rad, and share of the machine's size): the largest error of axes that count
as square or meeting. lump: the largest share of a leg's moments that crosses within joints may have; it is left
out. leave_out: what of the file is left out, as in the command line. key: a keyframe whose pose is the initial one.
The scenario's `assumptions` lists the assumptions made; warnings.warn() says those with `warning`, such as a
closure that is open by more than 1e-3 of the machine's size. Raises ScenarioError.)";

constexpr const char* assumptions =
    "The assumptions of import_model(): a list of dicts with what, where, size, unit and warning, warnings first. "
    "Empty "
    "for other scenarios.";

constexpr const char* to_dict =
    R"(The scenario's source as a dict: every key that it gives, and the full paths of the files that it names.
scenario(s.to_dict()) has the same numbers.)";

constexpr const char* to_toml =
    R"(The text of the scenario's source. scenario(s.to_toml()) is the same scenario, with the same hash; relative paths
in it start from the folder of s.file.)";

constexpr const char* scenario =
    "A machine, its commanded motion and the settings of its validation; read_scenario and scenario make it.";

constexpr const char* at =
    R"(The commanded motion at t, s: (N,) or a number, in [0, duration]. An instant beyond either end by at
most 4 eps duration is moved to it. Raises ValueError for an instant further out or not finite.)";

constexpr const char* inverse_dynamics =
    R"(Efforts of the six motors, in leg order, for a motion of N instants: (N, 6), by (37); N m, or N if a motor
slides. Each is conjugate to the rate of its coordinate; for the paper's legs this is phi_i, positive about -u_i.
The scenario's load acts at each t. `ursula inverse` writes the same numbers, to the last bit, on this machine.
jobs: number of threads, 0 for all of the processor; the numbers do not depend on it.
Raises PoseError if the legs cannot reach a pose or it is singular. Raises ValueError, which names the instant,
if an effort is not finite.)";

constexpr const char* forward_dynamics =
    R"(Accelerations (a, alpha) of the platform under efforts tau, N m or N, (N, 6), in the states of a motion of N instants,
by (36): of P, m/s², and angular, rad/s², in B, each (N, 3). The motion's own a and alpha are not read.
jobs: as for inverse_dynamics.
Raises PoseError and ValueError as inverse_dynamics does.)";

constexpr const char* inverse_kinematics =
    R"(Joint variables for a motion of N instants, as a dict of arrays (N, number of legs): phi, psi, theta, rad, and d,
m, if any leg has them; their rates phidot, …, ddot and accelerations phiddot, …, dddot. NaN for a leg
that has no such coordinate. Raises PoseError and ValueError as inverse_dynamics does.)";

constexpr const char* effort_derivatives =
    R"(Derivatives of inverse_dynamics(m), exact to rounding, as a dict of arrays (N, 6, 3): by "orientation", "p",
"w", "v", "alpha" and "a", all in B. "orientation" means a small turn d, rad, in B: Q becomes exp([d]x) Q,
while w, v, alpha and a stay. Raises PoseError and ValueError as inverse_dynamics does.)";

constexpr const char* parameter_derivatives =
    R"((names, derivatives): derivatives by every number of the machine, SI, (N, 6, number of names). Names are keys of a
sweep: "manipulator.leg.2.distal.mass", "manipulator.platform.inertia.3" for its fourth entry, xy.
An inertia's xy also stands for yx. Raises PoseError and ValueError as inverse_dynamics does.)";

constexpr const char* regressor =
    R"((names, values, Y): the parameters in which efforts are linear for a given geometry, their values of this machine,
and Y, (N, 6, number of names). Y @ values equals inverse_dynamics(m) of the machine without its load. Parameters
are masses, first moments, kg m, inertias about P and about the links' first ends, kg m^2, and friction.
Raises PoseError and ValueError as inverse_dynamics does.)";

constexpr const char* direct_kinematics =
    R"(Computes every real pose of the platform, as a list of Pose, for six actuated coordinates. These are angles phi of
URS legs, rad, with at most eight poses, those that assemble first; or lengths d of actuated UPS legs, m, with at
most 40 poses. Raises UndeterminedPose if they leave the platform free to move, ValueError unless they are six
finite numbers, or for legs of other kinds, and RuntimeError if a pose may be missing.)";

constexpr const char* simulate =
    R"(Computes the motion that efforts (N, 6), N m or N, at instants t (N,), s, produce, as a Simulation. It starts in
the commanded state at the first instant; a spline joins the efforts. engine: 'noc', by (36), or 'simbody', the
closed loop. For a MechanismScenario efforts are (N, n). time_limit: wall time, s, after which the simulation stops. Raises ValueError for fewer than six
instants.)";

constexpr const char* simulation = "The motion that efforts produce; made by simulate.";

constexpr const char* check_scenario =
    R"(Returns warnings of values that are valid but unusual, a list of text with file, line and column. Its `blind` is a
list of mistakes that machine and motion would let pass: dicts with mistake, cause and largest. Raises
ScenarioError or PoseError if the scenario's motion is not possible.)";

constexpr const char* map =
    R"(Maps reach, condition number, leg margins and largest effort over a grid of poses at rest. The result is a dict
of the arrays that `ursula map` writes. x, y, z, m, roll, pitch, yaw, degrees: a number, or (from, to, count); two
or three vary, by default x, y, z around the path. at: the instant, s, whose pose gives the other coordinates.
jobs: number of threads, 0 for all. Raises ValueError for an invalid grid.)";

constexpr const char* compare =
    R"(Compares two histories channel by channel and returns a Comparison. reference, test: a Result, a dict of arrays
with t_s, or the path of a CSV or of a result folder. tolerance: relative to the largest value of the channel's
group. time_tolerance: s. interpolate: whether to interpolate the reference between its instants; by default, if
it is at least as fine as the test. columns: patterns such as "tau_*"; default: all. Raises ValueError for
histories that cannot be compared.)";

constexpr const char* comparison =
    "A comparison of two histories, channel by channel; made by compare. str() gives the program's table.";

constexpr const char* validate = R"(Validates a scenario and returns a Result.

s: a Scenario, a MechanismScenario, or the path of a scenario file.

solver: the solver under test instead of this program's own. It is a function f(m) that gives the efforts (N, 6),
N m or N, for a Motion of any number N of instants. For a mechanism it gets a MechanismMotion and gives (N, n), with one
column for each of the n motors; so have torques. One thread at a time calls it, in any order of instants.
Checks that need a second machine, kinematics or direct dynamics are then not applicable.

torques, t: efforts (N, 6), N m or N, under test instead, at instants (N,), s. They are judged as
`ursula validate --torques` judges a file that gives each number by its shortest text.

rtol, atol: the largest errors of torques that pass, relative to the largest effort of the motion (1e-3, or
'0.1%'), and in N m or N; their sum counts. If both are omitted, [acceptance] torque of the scenario counts, else rounding.
name: name of the solver in the results; default: the function's own.
any_tolerance: accepts even a tolerance at which efforts of zero would pass.
thorough: asks the solver at every instant that an integrator wants, some 20,000. Without it the solver is asked at most
2,000 times, and an error may be missed that is shorter than the time between; the result states that time.
quick: judges the samples alone.
progress: a function of the share done, from 0 to 1, and of a text. By default a terminal or a notebook shows a bar;
False shows nothing.

accelerations: a simulator under test instead: a function f(m, tau) that gives the platform's accelerations in B,
(a, alpha), (N, 3) each, for a Motion and efforts (N, 6). For a mechanism it gives (N, n), those of the motors'
coordinates. The accelerations in m are zero.

time_limit: wall time, s; checks that it cuts short are inconclusive. Signal handlers, such as that of Ctrl-C,
run, and an exception that they raise ends the validation.

Raises the solver's own exceptions unchanged, ValueError if its answer has another shape or is not finite, and
PoseError if the commanded motion is out of reach or singular.)";

constexpr const char* cause = "One cause of wrong efforts; fields that do not apply are None.";
constexpr const char* finding = "A fact of a validation that is not judged.";

constexpr const char* deviation = "The largest deviation of the efforts under test from the expected ones.";

constexpr const char* replay_error = "The sources of the judged replay's deviation from the path.";

constexpr const char* result = "The result of one validation.";

constexpr const char* write =
    R"(Writes summary.json, timeseries.csv, report.html and junit.xml into a folder, which is created if necessary. All
files appear at once: a reader sees all of them or the earlier ones. Raises OSError if it cannot be written.)";

constexpr const char* check =
    R"(One judged comparison. It passes exactly if value <= limit; basis gives the origin of the limit, why the details
that were found.)";

}  // namespace ursula::python::words
