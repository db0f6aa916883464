#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <utility>

#include "model/quaternions.h"
#include "model/torque_names.h"
#include "validation/findings/findings.h"
#include "validation/replay/windows.h"

namespace ursula {
namespace {

template <class Rows, class F>
std::vector<double> valuesOf(const Rows& rows, F&& value) {
  std::vector<double> out;
  out.reserve(rows.size());
  for (const auto& row : rows) out.push_back(value(row));
  return out;
}

/// Adds columns to a series, named by quantity and unit.
class Columns {
 public:
  /// The rows' numbers become SI by `from`; null if they are in SI.
  explicit Columns(TimeSeries& series, const FrameChange* from = nullptr) : series_(series), from_(from) {}

  template <class Rows, class F>
  void add(const std::string& quantity, const std::string& unit, const Rows& rows, F&& value, double offset = 0) {
    const double size = from_ == nullptr ? 1 : from_->units.sizeOf(unit);
    series_.add(quantity + (unit.empty() ? "" : "_") + unit, valuesOf(rows, [&](const auto& row) {
                  return from_ == nullptr ? value(row) : value(row) * size + offset;
                }));
  }

  /// `pattern` contains one {} for x, y, z.
  template <class Rows, class F>
  void addVector(const std::string& pattern, const std::string& unit, const Rows& rows, F&& vector,
                 const Vector3d& offset = Vector3d::Zero()) {
    const char* axes[] = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k)
      add(
          fmt::format(fmt::runtime(pattern), axes[k]), unit, rows, [&](const auto& row) { return vector(row)(k); },
          offset(k));
  }

  template <class Rows, class F>
  void addPosition(const std::string& pattern, const Rows& rows, F&& position) {
    addVector(pattern, "m", rows, position, from_ == nullptr ? Vector3d(Vector3d::Zero()) : from_->origin);
  }

 private:
  TimeSeries& series_;
  const FrameChange* from_;
};

bool reachesEnd(const WindowedReplay& window) {
  return window.window.end() - window.replay.steps.back().t <= 1e-12 * window.window.end();
}

Curve replayAndLimit(const std::vector<WindowedReplay>& windows, double position_scale, const Units& units) {
  std::vector<double> t, error, limit;
  for (const WindowedReplay& window : windows)
    for (const ReplayStep& step : window.replay.steps) {
      t.push_back(step.t * units.time);
      error.push_back(step.position_error.norm() * units.length);
      limit.push_back(replayLimit(window, position_scale, step.t) * units.length);
      if (&step != &window.replay.steps.back() || reachesEnd(window)) continue;
      t.push_back(window.window.end() * units.time);  // nothing was computed after this
      error.push_back(std::nan(""));
      limit.push_back(std::nan(""));
    }
  return {Curve::About::limit,
          "Replay against its derived limit",
          "t",
          true,
          t,
          {{"position error", "m", error}, {"derived limit", "m", limit, CurveLine::Role::limit}}};
}

Curve growth(const std::vector<WindowedReplay>& windows, const Units& units) {
  std::vector<double> t, from_state, from_velocity;
  for (const WindowedReplay& window : windows) {
    for (const double each : window.window.t) t.push_back(each * units.time);
    from_state.insert(from_state.end(), window.window.from_start.begin(), window.window.from_start.end());
    for (const double each : window.window.growth) from_velocity.push_back(each * units.time);
  }
  return {Curve::About::numerics,
          "Growth of a deviation at the start of its window",
          "t",
          true,
          t,
          {{"of the state", "1", from_state}, {"of the velocity", "s", from_velocity}}};
}

Curve distances(const std::vector<PointwiseSample>& samples, const Units& units) {
  using Sample = PointwiseSample;
  Curve out = {Curve::About::numerics, "Distance to singular poses and to the workspace's edge", "t", true,
               valuesOf(samples, [&](const Sample& sample) { return sample.motion.t * units.time; })};
  out.lines.push_back({"1/κ(B): 0 in a singular pose", "",
                       valuesOf(samples, [](const Sample& sample) { return 1 / sample.conditioning.kappa_B; })});
  // Telescopic legs have no bend, so their sine is always 1.
  const auto bends = [](const Sample& sample) { return sample.conditioning.smallest_sine < 1; };
  if (std::any_of(samples.begin(), samples.end(), bends))
    out.lines.push_back({"sine of the bend: 0 in a stretched or folded leg", "",
                         valuesOf(samples, [](const Sample& sample) { return sample.conditioning.smallest_sine; })});
  return out;
}

void addEvents(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
               const Units& units, ValidationResult& result) {
  const auto add = [&](double t, const char* what) { result.events.push_back({t * units.time, what}); };
  for (const WindowedReplay& window : windows) {
    const Replay& replay = window.replay;
    if (!replay.gave_up.empty()) add(replay.stopped_at, "the replay stopped");
    if (replay.left_path) add(replay.steps.back().t, "the replay left the path");
  }
  if (samples.empty()) return;
  add(nearestToSingular(samples).motion.t, "nearest to a singular pose");
  const PointwiseSample& edge = nearestToEdge(samples);
  if (edge.conditioning.smallest_sine < 1) add(edge.motion.t, "a leg is nearest to stretched or folded");
}

}  // namespace

void addCurves(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
               const FrameChange& from, ValidationResult& result) {
  addEvents(samples, windows, from.units, result);
  if (!windows.empty()) {
    result.curves.push_back(replayAndLimit(windows, positionScale(samples), from.units));
    result.curves.push_back(growth(windows, from.units));
  }
  result.curves.push_back(distances(samples, from.units));
}

Curve workPrecision(const Ladder& ladder, const Units& units) {
  return {
      Curve::About::numerics,
      "Work and precision",
      "evaluations",
      false,
      valuesOf(ladder.rungs, [](const Rung& rung) { return static_cast<double>(rung.evaluations); }),
      {{"rkf78_error_m", "", valuesOf(ladder.rungs, [&](const Rung& rung) { return rung.distance * units.length; })}}};
}

namespace {

/// Adds one column per motor's effort.
template <class Rows, class F>
void addEfforts(Columns& columns, const std::string& prefix, const Motors& motors, const Rows& rows, F&& efforts) {
  for (std::size_t k = 0; k < motors.size(); ++k)
    columns.add(fmt::format("{}tau_{}", prefix, k + 1), motors[k].effortUnit(), rows,
                [&](const auto& row) { return efforts(row)(static_cast<Eigen::Index>(k)); });
}

/// Adds φ, ψ, θ, d of the legs that have them, or their rates `per` time, grouped by coordinate.
template <class Rows, class F>
void addCoordinates(Columns& columns, const char* rate, const char* per, const Manipulator& machine, const Rows& rows,
                    F&& of) {
  for (const Coordinate coordinate : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d})
    for (int i = 0; i < machine.legCount(); ++i) {
      const auto& has = rowOf(machine.leg(i).kind).coordinates;
      if (std::find(has.begin(), has.end(), coordinate) == has.end()) continue;
      columns.add(fmt::format("{}{}_{}", nameOf(coordinate), rate, i + 1),
                  std::string(slides(coordinate) ? "m" : "rad") + per, rows,
                  [&](const auto& row) { return of(row).of(coordinate)(i); });
    }
}

void addRotation(Columns& columns, const std::string& prefix, const std::vector<Motion<double>>& motions) {
  const std::vector<Eigen::Vector4d> q = quaternions(motions);
  for (int k = 0; k < 4; ++k)
    columns.add(prefix + "wxyz"[k], "", q, [k](const Eigen::Vector4d& row) { return row(k); });
}

void addMotion(Columns& columns, const std::vector<Motion<double>>& motions) {
  columns.add("t", "s", motions, [](const Motion<double>& m) { return m.t; });
  columns.addPosition("p_{}", motions, [](const Motion<double>& m) { return m.p; });
  addRotation(columns, "q_", motions);
  columns.addVector("v_{}", "m_s", motions, [](const Motion<double>& m) { return m.p_dot; });
  columns.addVector("w_{}", "rad_s", motions, [](const Motion<double>& m) { return m.omega; });
  columns.addVector("a_{}", "m_s2", motions, [](const Motion<double>& m) { return m.p_ddot; });
  columns.addVector("alpha_{}", "rad_s2", motions, [](const Motion<double>& m) { return m.omega_dot; });
}

/// `joints` returns the joints of a row.
template <class Rows, class F>
void addJoints(Columns& columns, const Manipulator& machine, const Rows& rows, F&& joints) {
  using Variables = JointVariables<double>;
  addCoordinates(columns, "", "", machine, rows, [&](const auto& row) -> const Variables& { return joints(row).q; });
  addCoordinates(columns, "dot", "_s", machine, rows,
                 [&](const auto& row) -> const Variables& { return joints(row).q_dot; });
  addCoordinates(columns, "ddot", "_s2", machine, rows,
                 [&](const auto& row) -> const Variables& { return joints(row).q_ddot; });
}

const WindowedReplay* windowAt(const std::vector<WindowedReplay>& windows, double t) {
  for (const WindowedReplay& window : windows)
    if (t <= window.window.end()) return &window;
  return windows.empty() ? nullptr : &windows.back();
}

/// Whether the replay reached t; the ends of two integrators differ by rounding.
bool reached(const Replay& replay, double t) {
  return !replay.steps.empty() && t <= replay.steps.back().t * (1 + 1e-12);
}

/// Returns a step of NaN for an instant after a replay stopped.
ReplayStep notComputed(double t) {
  const Vector3d none = Vector3d::Constant(std::nan(""));
  return {t, none, none, none, none, {std::nan(""), std::nan("")}, std::nan("")};
}

void addReplay(Columns& columns, const std::vector<Motion<double>>& motions,
               const std::vector<WindowedReplay>& windows) {
  std::vector<ReplayStep> steps;
  steps.reserve(motions.size());
  for (const Motion<double>& motion : motions) {
    const WindowedReplay* window = windowAt(windows, motion.t);
    if (window == nullptr) return;
    steps.push_back(reached(window->replay, motion.t) ? interpolated(window->replay, motion.t) : notComputed(motion.t));
  }
  std::vector<Motion<double>> simulated = motions;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    simulated[k].p += steps[k].position_error;
    const double angle = steps[k].rotation_error.norm();
    if (std::isnan(angle)) simulated[k].Q.setConstant(angle);
    if (angle > 0)
      simulated[k].Q = Eigen::AngleAxisd(angle, steps[k].rotation_error / angle).toRotationMatrix() * simulated[k].Q;
  }
  columns.addPosition("sim_p_{}", simulated, [](const Motion<double>& m) { return m.p; });
  addRotation(columns, "sim_q_", simulated);
  columns.add("error_p", "m", steps, [](const ReplayStep& s) { return s.position_error.norm(); });
  columns.add("error_q", "rad", steps, [](const ReplayStep& s) { return s.rotation_error.norm(); });
  columns.add("closure_p", "m", steps, [](const ReplayStep& s) { return s.closure.position; });
  columns.add("closure_v", "m_s", steps, [](const ReplayStep& s) { return s.closure.velocity; });
  columns.add("error_energy", "J", steps, [](const ReplayStep& s) { return s.energy_error; });
}

}  // namespace

TimeSeries inverseSeries(const Manipulator& machine, const std::vector<Motion<double>>& motions,
                         const std::vector<JointMotion>& joints, const std::vector<Vector6d>& efforts) {
  TimeSeries series;
  Columns columns(series);
  addMotion(columns, motions);
  addJoints(columns, machine, joints, [](const JointMotion& row) -> const JointMotion& { return row; });
  addEfforts(columns, "", machine.motors(), efforts, [](const Vector6d& tau) { return tau; });
  return series;
}

TimeSeries simulatedSeries(const Manipulator& machine, const std::vector<Motion<double>>& motions,
                           const std::vector<Vector6d>& efforts) {
  TimeSeries series;
  Columns columns(series);
  addMotion(columns, motions);
  addEfforts(columns, "", machine.motors(), efforts, [](const Vector6d& tau) { return tau; });
  return series;
}

TimeSeries validationSeries(const Manipulator& machine, const std::vector<PointwiseSample>& samples,
                            const std::vector<WindowedReplay>& windows, const FrameChange& from) {
  std::vector<Motion<double>> motions;
  motions.reserve(samples.size());
  for (const PointwiseSample& sample : samples) motions.push_back(sample.motion);
  TimeSeries series;
  Columns columns(series, &from);
  addMotion(columns, motions);
  addJoints(columns, machine, samples, [](const PointwiseSample& s) -> const JointMotion& { return s.joints; });
  addEfforts(columns, "", machine.motors(), samples, [](const PointwiseSample& s) { return s.torques; });
  using Sample = PointwiseSample;
  addEfforts(columns, "simbody_", machine.motors(), samples, [](const Sample& s) { return s.torques_simbody; });
  const std::string unit = effortSuffix(machine.motors());
  columns.add("error_tau", unit, samples, [](const Sample& s) { return s.torque.error; });
  columns.add("limit_tau", unit, samples, [](const Sample& s) { return s.torque.limit; });
  if (std::any_of(samples.begin(), samples.end(), [](const Sample& s) { return !s.torques_given.isZero(0); }))
    addEfforts(columns, "limit_", machine.motors(), samples, [](const Sample& s) { return s.torqueLimits(); });
  columns.add("error_acceleration", "m_s2", samples, [](const Sample& s) { return s.acceleration.error; });
  columns.add("limit_acceleration", "m_s2", samples, [](const Sample& s) { return s.acceleration.limit; });
  addReplay(columns, motions, windows);
  return series;
}

void addReactionColumns(const Manipulator& machine, const std::vector<ReactionSample>& reactions,
                        const FrameChange& from, TimeSeries& series) {
  const std::tuple<const char*, const char*, Vector3d LegReactions::*> parts[] = {{"fA", "N", &LegReactions::f_A},
                                                                                  {"nA", "Nm", &LegReactions::n_A},
                                                                                  {"fR", "N", &LegReactions::f_R},
                                                                                  {"nR", "Nm", &LegReactions::n_R},
                                                                                  {"fB", "N", &LegReactions::f_B}};
  Columns columns(series, &from);
  for (const auto& [what, unit, member] : parts)
    for (std::size_t leg = 0; leg < machine.parameters().legs.size(); ++leg)
      columns.addVector(fmt::format("reaction_{}_{{}}_{}", what, leg + 1), unit, reactions,
                        [leg, member = member](const ReactionSample& row) { return row.recovered[leg].*member; });
}

}  // namespace ursula
