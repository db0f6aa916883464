#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <utility>

#include "model/quaternions.h"
#include "validation/findings/findings.h"
#include "validation/replay/windows.h"
#include "validation/subject/torque_names.h"

namespace ursula {
namespace {

template <class Rows, class F>
void addColumn(TimeSeries& series, const std::string& column, const Rows& rows, F&& value) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const auto& row : rows) values.push_back(value(row));
  series.add(column, std::move(values));
}

/// `pattern` contains one {} for x, y, z.
template <class Rows, class F>
void addVector(TimeSeries& series, const std::string& pattern, const Rows& rows, F&& vector) {
  const char* axes[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k)
    addColumn(series, fmt::format(fmt::runtime(pattern), axes[k]), rows,
              [&](const auto& row) { return vector(row)(k); });
}

bool reachesEnd(const WindowedReplay& window) {
  return window.window.end() - window.replay.steps.back().t <= 1e-12 * window.window.end();
}

TimeSeries replayAndLimit(const std::vector<WindowedReplay>& windows, double position_scale) {
  std::vector<double> t, error, limit;
  for (const WindowedReplay& window : windows)
    for (const ReplayStep& step : window.replay.steps) {
      t.push_back(step.t);
      error.push_back(step.position_error.norm());
      limit.push_back(replayLimit(window, position_scale, step.t));
      if (&step != &window.replay.steps.back() || reachesEnd(window)) continue;
      t.push_back(window.window.end());  // nothing was computed after this
      error.push_back(std::nan(""));
      limit.push_back(std::nan(""));
    }
  return {{"t_s", "position error (m)", "derived limit (m)"}, {t, error, limit}};
}

TimeSeries growth(const std::vector<WindowedReplay>& windows) {
  std::vector<double> t, from_state, from_velocity;
  for (const WindowedReplay& window : windows) {
    t.insert(t.end(), window.window.t.begin(), window.window.t.end());
    from_state.insert(from_state.end(), window.window.from_start.begin(), window.window.from_start.end());
    from_velocity.insert(from_velocity.end(), window.window.growth.begin(), window.window.growth.end());
  }
  return {{"t_s", "of the state (1)", "of the velocity (s)"}, {t, from_state, from_velocity}};
}

TimeSeries distances(const std::vector<PointwiseSample>& samples) {
  using Sample = PointwiseSample;
  TimeSeries out;
  addColumn(out, "t_s", samples, [](const Sample& sample) { return sample.motion.t; });
  addColumn(out, "1/κ(B): 0 in a singular pose", samples, [](const Sample& s) { return 1 / s.conditioning.kappa_B; });
  // Telescopic legs have no bend, so their sine is always 1.
  const auto bends = [](const Sample& sample) { return sample.conditioning.smallest_sine < 1; };
  if (std::any_of(samples.begin(), samples.end(), bends))
    addColumn(out, "sine of the bend: 0 in a stretched or folded leg", samples,
              [](const Sample& sample) { return sample.conditioning.smallest_sine; });
  return out;
}

void addEvents(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
               ValidationResult& result) {
  for (const WindowedReplay& window : windows) {
    if (&window != &windows.front()) result.events.push_back({window.window.start(), "the replay starts again"});
    const Replay& replay = window.replay;
    if (!replay.gave_up.empty()) result.events.push_back({replay.stopped_at, "the replay stopped"});
    if (replay.left_path) result.events.push_back({replay.steps.back().t, "the replay left the path"});
  }
  if (samples.empty()) return;
  result.events.push_back({nearestToSingular(samples).motion.t, "nearest to a singular pose"});
  const PointwiseSample& edge = nearestToEdge(samples);
  if (edge.conditioning.smallest_sine < 1)
    result.events.push_back({edge.motion.t, "a leg is nearest to stretched or folded"});
}

}  // namespace

void addCurves(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
               ValidationResult& result) {
  addEvents(samples, windows, result);
  if (!windows.empty()) {
    result.curves.emplace_back("Replay against its derived limit", replayAndLimit(windows, positionScale(samples)));
    result.curves.emplace_back("Growth of a deviation at the start of its window", growth(windows));
  }
  result.curves.emplace_back("Distance to singular poses and to the workspace's edge", distances(samples));
}

TimeSeries workPrecision(const Ladder& ladder) {
  TimeSeries series;
  addColumn(series, "evaluations", ladder.rungs,
            [](const Rung& rung) { return static_cast<double>(rung.evaluations); });
  addColumn(series, "rkf78_error_m", ladder.rungs, [](const Rung& rung) { return rung.distance; });
  return series;
}

namespace {

/// Adds one column per motor's effort.
template <class Rows, class F>
void addEfforts(TimeSeries& series, const std::string& prefix, const Motors& motors, const Rows& rows, F&& efforts) {
  for (int k = 0; k < motor_count; ++k)
    addColumn(series, prefix + effortColumn(motors, k), rows, [&](const auto& row) { return efforts(row)(k); });
}

/// Adds φ, ψ, θ, d of the legs that have them, grouped by coordinate.
template <class Rows, class F>
void addCoordinates(TimeSeries& series, const std::string& rate, const Manipulator& machine, const Rows& rows, F&& of) {
  const std::string per = rate.empty() ? "" : rate == "dot" ? "_s" : "_s2";
  for (const Coordinate coordinate : {Coordinate::phi, Coordinate::psi, Coordinate::theta, Coordinate::d})
    for (int i = 0; i < machine.legCount(); ++i) {
      const auto& has = rowOf(machine.leg(i).kind).coordinates;
      if (std::find(has.begin(), has.end(), coordinate) == has.end()) continue;
      addColumn(series,
                fmt::format("{}{}_{}_{}{}", nameOf(coordinate), rate, i + 1, slides(coordinate) ? "m" : "rad", per),
                rows, [&](const auto& row) { return of(row).of(coordinate)(i); });
    }
}

void addRotation(TimeSeries& series, const std::string& prefix, const std::vector<Motion<double>>& motions) {
  const std::vector<Eigen::Vector4d> q = quaternions(motions);
  for (int k = 0; k < 4; ++k)
    addColumn(series, prefix + "wxyz"[k], q, [k](const Eigen::Vector4d& row) { return row(k); });
}

void addMotion(TimeSeries& series, const std::vector<Motion<double>>& motions) {
  addColumn(series, "t_s", motions, [](const Motion<double>& m) { return m.t; });
  addVector(series, "p_{}_m", motions, [](const Motion<double>& m) { return m.p; });
  addRotation(series, "q_", motions);
  addVector(series, "v_{}_m_s", motions, [](const Motion<double>& m) { return m.p_dot; });
  addVector(series, "w_{}_rad_s", motions, [](const Motion<double>& m) { return m.omega; });
  addVector(series, "a_{}_m_s2", motions, [](const Motion<double>& m) { return m.p_ddot; });
  addVector(series, "alpha_{}_rad_s2", motions, [](const Motion<double>& m) { return m.omega_dot; });
}

/// `joints` returns the joints of a row.
template <class Rows, class F>
void addJoints(TimeSeries& series, const Manipulator& machine, const Rows& rows, F&& joints) {
  using Variables = JointVariables<double>;
  addCoordinates(series, "", machine, rows, [&](const auto& row) -> const Variables& { return joints(row).q; });
  addCoordinates(series, "dot", machine, rows, [&](const auto& row) -> const Variables& { return joints(row).q_dot; });
  addCoordinates(series, "ddot", machine, rows,
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

void addReplay(TimeSeries& series, const std::vector<Motion<double>>& motions,
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
  addVector(series, "sim_p_{}_m", simulated, [](const Motion<double>& m) { return m.p; });
  addRotation(series, "sim_q_", simulated);
  addColumn(series, "error_p_m", steps, [](const ReplayStep& s) { return s.position_error.norm(); });
  addColumn(series, "error_q_rad", steps, [](const ReplayStep& s) { return s.rotation_error.norm(); });
  addColumn(series, "closure_p_m", steps, [](const ReplayStep& s) { return s.closure.position; });
  addColumn(series, "closure_v_m_s", steps, [](const ReplayStep& s) { return s.closure.velocity; });
  addColumn(series, "error_energy_J", steps, [](const ReplayStep& s) { return s.energy_error; });
}

}  // namespace

TimeSeries inverseSeries(const Manipulator& machine, const std::vector<Motion<double>>& motions,
                         const std::vector<JointMotion>& joints, const std::vector<Vector6d>& efforts) {
  TimeSeries series;
  addMotion(series, motions);
  addJoints(series, machine, joints, [](const JointMotion& row) -> const JointMotion& { return row; });
  addEfforts(series, "", machine.motors(), efforts, [](const Vector6d& tau) { return tau; });
  return series;
}

TimeSeries simulatedSeries(const Manipulator& machine, const std::vector<Motion<double>>& motions,
                           const std::vector<Vector6d>& efforts) {
  TimeSeries series;
  addMotion(series, motions);
  addEfforts(series, "", machine.motors(), efforts, [](const Vector6d& tau) { return tau; });
  return series;
}

TimeSeries validationSeries(const Manipulator& machine, const std::vector<PointwiseSample>& samples,
                            const std::vector<WindowedReplay>& windows) {
  std::vector<Motion<double>> motions;
  motions.reserve(samples.size());
  for (const PointwiseSample& sample : samples) motions.push_back(sample.motion);
  TimeSeries series;
  addMotion(series, motions);
  addJoints(series, machine, samples, [](const PointwiseSample& s) -> const JointMotion& { return s.joints; });
  addEfforts(series, "", machine.motors(), samples, [](const PointwiseSample& s) { return s.torques; });
  using Sample = PointwiseSample;
  addEfforts(series, "simbody_", machine.motors(), samples, [](const Sample& s) { return s.torques_simbody; });
  const std::string unit = effortSuffix(machine.motors());
  addColumn(series, "error_tau_" + unit, samples, [](const Sample& s) { return s.torque.error; });
  addColumn(series, "limit_tau_" + unit, samples, [](const Sample& s) { return s.torque.limit; });
  addColumn(series, "error_acceleration_m_s2", samples, [](const Sample& s) { return s.acceleration.error; });
  addColumn(series, "limit_acceleration_m_s2", samples, [](const Sample& s) { return s.acceleration.limit; });
  addReplay(series, motions, windows);
  return series;
}

void addReactionColumns(const Manipulator& machine, const std::vector<ReactionSample>& reactions, TimeSeries& series) {
  const std::tuple<const char*, const char*, Vector3d LegReactions::*> columns[] = {{"fA", "N", &LegReactions::f_A},
                                                                                    {"nA", "Nm", &LegReactions::n_A},
                                                                                    {"fR", "N", &LegReactions::f_R},
                                                                                    {"nR", "Nm", &LegReactions::n_R},
                                                                                    {"fB", "N", &LegReactions::f_B}};
  for (const auto& [what, unit, member] : columns)
    for (std::size_t leg = 0; leg < machine.parameters().legs.size(); ++leg)
      addVector(series, fmt::format("reaction_{}_{{}}_{}_{}", what, leg + 1, unit), reactions,
                [leg, member = member](const ReactionSample& row) { return row.recovered[leg].*member; });
}

}  // namespace ursula
