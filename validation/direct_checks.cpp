#include "validation/direct_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/simbody_loop.h"
#include "nocsolver/errors.h"
#include "validation/judge_replay.h"
#include "validation/windows.h"
#include "validation/worst.h"

namespace ursula {
namespace {

/// Of the samples, about as many: the mass matrix changes slowly.
constexpr std::size_t instants_of_direct = 31;

Vector6d accelerationsOf(SimbodyLoop& loop, const Vector6d& torques) {
  loop.accelerate(torques);
  const Motion<double> found = loop.platform();
  Vector6d out;
  out << found.omega_dot, found.p_ddot;
  return out;
}

double spin(const Vector6d& v, double length) { return v.tail<3>().norm() + length * v.head<3>().norm(); }

/// Deviations grow this many times over the time compared, or as often as they do at all.
constexpr double wanted_growth = 100;
/// A deviation at the end of that, over the machine's length: linear to its square.
constexpr double wanted_deviation = 1e-5;

/// The last instant of the first window in which deviations have grown by no more than wanted, at least one interval.
std::size_t lastOf(const Amplification& amplification) {
  const auto none = [](double) { return 0.0; };
  const GrowthWindow window = amplification.window(0, none, 1, wanted_growth);  // no longer than it takes
  std::size_t last = 1;
  while (last + 1 < window.t.size() && window.from_start[last + 1] <= wanted_growth) ++last;
  return last;
}

/// No coordinate is special; of length 1.
Amplification::Vector12 direction() {
  Amplification::Vector12 out;
  for (int i = 0; i < 12; ++i) out(i) = std::cos(1.0 + 2.3 * i);
  return out.normalized();
}

Vector6d deviationAtEnd(const Replay& replay, double length) {
  Vector6d out;
  out << replay.steps.back().position_error, length * replay.steps.back().rotation_error;
  return out;
}

}  // namespace

Check judgeDirect(const Scenario& scenario, const Subject& subject, const std::vector<PointwiseSample>& samples,
                  const Units& units) {
  static constexpr const char* check = "direct.pointwise";
  SimbodyLoop loop(*scenario.manipulator, SimbodyLoop::Topology::six_balls, scenario.load);
  Worst shown;
  double size = 0;
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / instants_of_direct);
  try {
    for (std::size_t k = 0; k < samples.size(); k += stride) {
      const PointwiseSample& sample = samples[k];
      const double length = sample.conditioning.length, change = sample.torques_simbody.cwiseAbs().maxCoeff();
      loop.place(sample.motion);
      for (int motor = -1; motor < leg_count; ++motor) {
        Vector6d torques = sample.torques_simbody;
        if (motor >= 0) torques(motor) += change;
        const Vector6d simbody = accelerationsOf(loop, torques);
        size = std::max(size, spin(simbody, length));
        shown.add(spin(subject.accelerations(sample.motion, torques) - simbody, length),
                  sample.conditioning.rounding(Rounded::direct), sample.motion.t, motor);
      }
    }
  } catch (const PoseError& error) {
    return notMade(check, "m/s^2", std::string("no answer: ") + error.what());
  }
  if (!shown.any) return notMade(check, "m/s^2", "no instant was compared");
  const auto motor = [](int where) { return where < 0 ? "as commanded" : fmt::format("motor {} changed", where + 1); };
  Check out = judgedIfUseful(
      check, shown.value, limitToJudge(shown, useful_share * size), useful_share * size, "m/s^2",
      fmt::format("eps (|| T_P inv(I) || x the torque's and the platform's compliance x the forces that close the "
                  "loops) x {:g} x the spread measured in turned and rescaled frames",
                  rounding_safety),
      fmt::format("platform accelerations by (36) against Simbody's, under seven sets of torques each; shown for "
                  "t = {:.6g} s, torques {}",
                  shown.t * units.time, motor(shown.where)),
      fmt::format("it exceeds {:g} of the largest acceleration", useful_share));
  out.largest = {shown.largest, shown.largest_t * units.time, motor(shown.largest_where)};
  return out;
}

Check judgeGrowth(const Scenario& scenario, const Subject& subject, const SimbodyLoop::TorqueHistory& torques,
                  const Amplification& amplification, const std::function<double(double)>& acceleration_rounding,
                  double tolerance, const Units& units) {
  static constexpr const char* check = "direct.growth";
  const std::size_t last = lastOf(amplification);
  const double end = amplification.instants()[last], length = amplification.length();
  const auto acceleration = [&subject](const Motion<double>& motion, const Vector6d& tau) {
    return subject.accelerations(motion, tau);
  };
  const auto intervals = static_cast<int>(last);
  const auto found = propagated(scenario, acceleration, end, intervals, 2);
  const auto finer = propagated(scenario, acceleration, end, 2 * intervals, 1);
  const Amplification::Vector12 from = direction();
  const Vector6d expected = (finer * from).head<6>();

  const double size = wanted_deviation * length / std::max(1.0, finer.topRows<6>().norm());
  ReplaySettings settings;
  settings.end = end;
  settings.max_evaluations = enoughEvaluations(scenario, plannedStepRate(scenario.trajectory->duration()));
  std::vector<Vector6d> ends;  // on the path, half beside it either way, and whole at a hundredth of the tolerance
  const std::pair<double, double> runs[] = {{0, 1}, {1, 1}, {-1, 1}, {1, coarser}, {-1, coarser}};
  for (const auto& [sign, finer_by] : runs) {
    settings.deviation = sign * size * (finer_by == 1 ? 0.5 : 1) * from;
    settings.tolerance = tolerance / finer_by;
    const Replay run = replay(scenario, torques, settings);
    if (!run.gave_up.empty() || run.left_path || run.steps.empty())
      return notJudgeable(Reason::unfinished, check, std::nan(""), std::nan(""), "", "",
                          "the replay from beside the path gave up: " + run.gave_up);
    ends.push_back(deviationAtEnd(run, length));
  }
  const Vector6d apart = ends[3] - ends[4];
  const double grown = expected.norm(), error = (apart - 2 * size * expected).norm() / (2 * size);
  // What is even in the deviation bounds what is cubic; intervals and differences of half the length show what the
  // others miss.
  const double bend = (ends[1] + ends[2] - 2 * ends[0]).norm() / size;
  const double magnus = ((finer - found) * from).head<6>().norm();
  const double integration = integration_safety * (2 * (ends[1] - ends[2]) - apart).norm() / (2 * size);
  const double rounding = amplification.carriedBound(0, end, acceleration_rounding) / size;
  return judged(
      check, error / grown, (bend + magnus + integration + rounding) / grown, "",
      fmt::format(
          "what is even in the deviation, what halved intervals and differences change, {:g} times what a hundredfold "
          "tolerance changes, and rounding of the accelerations",
          integration_safety),
      fmt::format("a deviation of the state by {:.2g} m grows {:.4g} times until t = {:.6g} s by the "
                  "variational equations; relative difference from Simbody put off the path as much either "
                  "way",
                  size * units.length, grown, end * units.time));
}

}  // namespace ursula
