#pragma once

// The text of `help(ursula)`.

namespace ursula::python::words {

constexpr const char* module =
    "Whether the closed-form dynamics of a six-dof parallel manipulator are right, and why.\n\n"
    "NumPy in and out; rows are instants; SI units; frames: B is the base's, M the platform's.";

constexpr const char* motion =
    "Motion(t, p, q, v=None, w=None, a=None, alpha=None)\n\n"
    "Pose, twist and twist rate of the platform at N instants. Arrays are views that cannot be written to.\n\n"
    "t: instants, s, (N,) or a number. p: position of P in B, m, (N, 3). q: unit quaternions [w, x, y, z] of M in B,\n"
    "(N, 4), normalised. v, w, a, alpha: velocity of P, m/s, angular velocity, rad/s, and their rates, in B, (N, 3);\n"
    "zero where left out. m[k] and m[i:j] are motions, too. Raises ValueError for other shapes and what is not finite.";

constexpr const char* q =
    "Orientation of M in B as unit quaternions [w, x, y, z]: (N, 4). w >= 0 in the first, and each on the side of the "
    "one "
    "before.";

constexpr const char* read_scenario =
    "Reads and checks a scenario file (TOML). Raises ScenarioError, with file, line and column.";

constexpr const char* scenario_of =
    "A Scenario of a dict or of text in TOML, with the keys of a scenario's file. Arrays of NumPy and paths may stand "
    "in\n"
    "a dict. folder: that relative paths are taken from; the current one where left out. Raises ScenarioError: with "
    "line\n"
    "and column of a text, with the key of a dict, whose lines are those of its to_toml().";

constexpr const char* import_model =
    "A Scenario of a model in SDF, MJCF or URDF. base and platform: bodies, where they are not unique. actuated: "
    "joints\n"
    "that motors drive, where the file does not say. close: pairs \"A:B\" of links whose frames a ball joins. "
    "tolerance\n"
    "(rad, and share of the machine's size): what is taken as square and meeting. lump: share of a leg's moments that\n"
    "crosses within joints may have and lose. What was taken for granted is in its assumptions. Raises ScenarioError.";

constexpr const char* assumptions =
    "What import_model() took for granted: a list of dicts with what, where, size and unit. Empty for other scenarios.";

constexpr const char* to_dict =
    "What the scenario was read from, as a dict: every key that it gives, and files that it names by their whole "
    "paths.\n"
    "scenario(s.to_dict()) has the same numbers.";

constexpr const char* to_toml =
    "The text that the scenario was read from. scenario(s.to_toml()) is the same scenario, with the same hash; "
    "relative\n"
    "paths in it are from the folder of s.file.";

constexpr const char* scenario =
    "A machine, what it is asked to do, and how that is judged; made by read_scenario and scenario.";

constexpr const char* at =
    "The commanded motion at t, s: (N,) or a number, in [0, duration]. An instant beyond either end by no more than\n"
    "4 eps duration is put on it. Raises ValueError for one that is further out or not finite.";

constexpr const char* inverse_dynamics =
    "Efforts of the six motors, in leg order, for a motion of N instants: (N, 6), by (37); N m, or N where a motor\n"
    "slides. Each is conjugate to the rate of what it drives, of the paper's legs phi_i, positive about -u_i. The\n"
    "scenario's load acts at each t. The same numbers, to the last bit, as `ursula inverse` writes on this machine.\n"
    "jobs: threads, 0 for all that the processor has; the numbers are the same for any.\n"
    "Raises PoseError where the legs cannot take a pose, or it is singular, and ValueError, which names the instant,\n"
    "where an effort is not finite.";

constexpr const char* forward_dynamics =
    "Accelerations (a, alpha) of the platform under efforts tau, N m or N, (N, 6), in the states of a motion of N "
    "instants,\n"
    "by (36): of P, m/s², and angular, rad/s², in B, each (N, 3). The motion's own a and alpha are not read.\n"
    "jobs as of inverse_dynamics.\n"
    "Raises PoseError and ValueError as inverse_dynamics does.";

constexpr const char* inverse_kinematics =
    "Joint variables for a motion of N instants, as a dict of arrays (N, number of legs): phi, psi, theta, rad, and "
    "d,\n"
    "m, as far as any leg has them; their rates phidot, …, ddot and accelerations phiddot, …, dddot. NaN for a leg\n"
    "that has no such coordinate. Raises PoseError and ValueError as inverse_dynamics does.";

constexpr const char* effort_derivatives =
    "Derivatives of inverse_dynamics(m), exact to rounding, as a dict of arrays (N, 6, 3): by \"orientation\", \"p\",\n"
    "\"w\", \"v\", \"alpha\" and \"a\", all in B. \"orientation\" is by a small turn d, rad, in B: Q becomes exp([d]x) "
    "Q,\n"
    "while w, v, alpha and a stay. Raises PoseError and ValueError as inverse_dynamics does.";

constexpr const char* parameter_derivatives =
    "(names, derivatives): by every number of the machine, SI, (N, 6, number of names), named as the keys of a\n"
    "sweep: \"manipulator.leg.2.distal.mass\", \"manipulator.platform.inertia.3\" for its fourth entry, xy.\n"
    "An inertia's xy is yx as well. Raises PoseError and ValueError as inverse_dynamics does.";

constexpr const char* regressor =
    "(names, values, Y): what efforts are linear in once the geometry is given, the machine's own values of them, and\n"
    "Y, (N, 6, number of names), with Y @ values = inverse_dynamics(m) of the machine without its load. Masses, first\n"
    "moments, kg m, inertias about P and about the links' first ends, kg m^2, friction.\n"
    "Raises PoseError and ValueError as inverse_dynamics does.";

constexpr const char* direct_kinematics =
    "Every real pose of the platform, as a list of Pose, for six actuated coordinates: angles phi of URS legs, rad, at "
    "most\n"
    "eight poses, first those that assemble; lengths d of UPS legs that push, m, at most 40. Raises UndeterminedPose\n"
    "where they leave the platform free to move, ValueError unless they are six finite numbers and for legs of other\n"
    "kinds, and RuntimeError where a pose may be missing.";

constexpr const char* simulate =
    "The motion that efforts (N, 6), N m or N, at instants t (N,), s, produce, as a Simulation: from the commanded "
    "state\n"
    "at the first of them, on a spline through them. engine: 'noc', by (36), or 'simbody', the closed loop. "
    "time_limit: "
    "s;\n"
    "the motion stops where it is after so many seconds of work. Raises ValueError for fewer than six instants.";

constexpr const char* simulation = "What efforts make of the machine; made by simulate.";

constexpr const char* check_scenario =
    "Warnings of what is possible in the scenario but odd, a list of text with file, line and column. Raises "
    "ScenarioError\n"
    "or PoseError where its motion cannot be made.";

constexpr const char* map =
    "What the machine can do over a grid of poses at rest, as a dict of arrays, those that `ursula map` writes: "
    "reach,\n"
    "condition number, leg margins, largest effort. x, y, z, m, roll, pitch, yaw, degrees: a number, or (from, to, "
    "count);\n"
    "two or three vary, by default x, y, z around the path. at: the instant, s, whose pose gives what is not said. "
    "jobs:\n"
    "threads, 0 for all. Raises ValueError for a grid that cannot be made.";

constexpr const char* compare =
    "Two histories channel by channel, as a Comparison. reference, test: a Result, a dict of arrays with t_s, or the "
    "path\n"
    "of a CSV or of a result folder. tolerance: relative to the largest of the channel's group. time_tolerance: s.\n"
    "interpolate: the reference between its instants; by default where it is at least as fine as the test. columns:\n"
    "patterns such as \"tau_*\"; all where left out. Raises ValueError for what cannot be compared.";

constexpr const char* comparison = "Two histories channel by channel; made by compare. str() is the program's table.";

constexpr const char* validate =
    "The whole validation of a scenario: a Result.\n\n"
    "solver: what is judged instead of this program's own solver, a function f(m) that gives the efforts (N, 6),\n"
    "N m or N, for a Motion of N instants, any number. It is called by one thread at a time, in any order of "
    "instants.\n"
    "What needs a second machine, kinematics or direct dynamics is not applicable then.\n\n"
    "torques, t: efforts (N, 6), N m or N, at instants (N,), s, that are judged instead, as `ursula validate "
    "--torques`\n"
    "judges a file that gives each number by its shortest text.\n\n"
    "rtol, atol: torques pass that are off by no more, relative to the largest effort of the motion, and N m or N; "
    "both\n"
    "are added. Where both are left out, [acceptance] torque of the scenario holds, else rounding. name: of the\n"
    "solver, for the results; its own where left out.\n"
    "any_tolerance: takes a tolerance at which efforts of zero would pass, which is refused else.\n"
    "time_limit: s; what is not reached by then is inconclusive. Handlers of signals, as that of Ctrl-C, run,\n"
    "and what they raise ends the validation.\n\n"
    "Raises what the solver raises, as it was raised; ValueError where it answers with another shape or with what is\n"
    "not finite; PoseError where the commanded motion is out of reach or singular.";

constexpr const char* cause = "One cause of wrong efforts; fields that do not apply are None.";
constexpr const char* finding = "A fact of a validation that is not judged.";

constexpr const char* deviation = "How far the efforts on trial are from the expected ones, where that is furthest.";

constexpr const char* replay_error = "What moved the judged replay off the path, source by source.";

constexpr const char* result = "What one validation found.";

constexpr const char* write =
    "Writes summary.json, timeseries.csv, report.html and junit.xml into a folder, which is made, at once: a reader\n"
    "sees all of them or what was there. Raises OSError where it cannot be written.";

constexpr const char* check =
    "One statement that was judged. It passes exactly if value <= limit; basis says where the limit comes from, why\n"
    "what was found.";

}  // namespace ursula::python::words
