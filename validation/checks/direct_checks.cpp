#include "validation/checks/direct_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/loops/simbody/simbody_loop.h"
#include "nocsolver/errors.h"
#include "validation/limits/growth.h"
#include "validation/replay/windowed_replay.h"
#include "validation/replay/windows.h"
#include "validation/samples/place_name.h"
#include "validation/verdict/worst_share.h"

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

/// Ends of replays from beside the path.
struct Beside {
  Vector6d on_path;          ///< from the commanded state itself
  Vector6d above, below;     ///< from half a deviation beside it either way
  Vector6d whole_apart;      ///< between the two from a whole one, at a hundredth of the tolerance
  std::string gave_up = "";  ///< why there are none
};

Beside replaysBeside(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, ReplaySettings settings,
                     double size, double length) {
  Beside out;
  const double tolerance = settings.tolerance;
  const auto endOf = [&](double share, double finer_by) {
    settings.deviation = share * size * direction();
    settings.tolerance = tolerance / finer_by;
    const Replay run = replay(scenario, torques, settings);
    if (run.gave_up.empty() && !run.left_path && !run.steps.empty()) return deviationAtEnd(run, length);
    if (out.gave_up.empty()) out.gave_up = "the replay from beside the path gave up: " + run.gave_up;
    return Vector6d(Vector6d::Constant(std::nan("")));
  };
  out.on_path = endOf(0, 1);
  out.above = endOf(0.5, 1);
  out.below = endOf(-0.5, 1);
  out.whole_apart = endOf(1, coarser) - endOf(-1, coarser);
  return out;
}

Check judgeBeside(const Growth& growth, const Beside& beside, double size, double end, double rounding,
                  const Units& units) {
  static constexpr const char* check = "direct.growth";
  if (!beside.gave_up.empty())
    return notJudgeable(Reason::unfinished, check, std::nan(""), std::nan(""), "", "", beside.gave_up);
  const Vector6d expected = (growth.Phi * direction()).head<6>();
  const double grown = expected.norm(), error = (beside.whole_apart - 2 * size * expected).norm() / (2 * size);
  // What is even in the deviation bounds what is cubic; intervals and differences of twice the length show more than
  // what these miss.
  const double bend = (beside.above + beside.below - 2 * beside.on_path).norm() / size;
  const double steps = ((growth.coarser - growth.Phi) * direction()).head<6>().norm() +
                       ((growth.blunter - growth.coarser) * direction()).head<6>().norm();
  const double integration =
      integration_safety * (2 * (beside.above - beside.below) - beside.whole_apart).norm() / (2 * size);
  return judged(check, error / grown, (bend + steps + integration + rounding) / grown, "",
                fmt::format("what is even in the deviation, what intervals and differences of twice the length change, "
                            "{:g} times what a hundredfold tolerance changes, and rounding of the accelerations",
                            integration_safety),
                fmt::format("a deviation of the state by {:.2g} m grows {:.4g} times until t = {:.6g} s by the "
                            "variational equations; relative difference from Simbody put off the path as much either "
                            "way",
                            size * units.length, grown, end * units.time));
}

}  // namespace

Check judgeDirect(const Scenario& scenario, const Subject& subject, const std::vector<PointwiseSample>& samples,
                  const RoundingProfile& profile, const Units& units) {
  static constexpr const char* check = "direct.pointwise";
  SecondLook look(profile);
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
        const double error = spin(subject.accelerations(sample.motion, torques) - simbody, length);
        shown.add(error, look.limit(error, sample.conditioning, Rounded::direct, sample.motion, 1, &torques),
                  sample.motion.t, motor);
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
      fmt::format("it exceeds {:g} of the largest acceleration: {}", useful_share,
                  causeOfRounding(samples, shown.widest_t)));
  out.largest = {shown.largest, shown.largest_t * units.time, motor(shown.largest_where)};
  return out;
}

Check judgeGrowth(const Scenario& scenario, const Subject& subject, const SimbodyLoop::TorqueHistory& torques,
                  const Amplification& amplification, const std::function<double(double)>& acceleration_rounding,
                  double tolerance, const Units& units, bool second_look) {
  const std::size_t last = lastOf(amplification);
  const double end = amplification.instants()[last], length = amplification.length();
  const auto acceleration = [&subject](const Motion<double>& motion, const Vector6d& tau) {
    return subject.accelerations(motion, tau);
  };
  const Growth growth = growthOf(scenario, acceleration, end, static_cast<int>(last));
  const double size = wanted_deviation * length / std::max(1.0, growth.Phi.topRows<6>().norm());
  const double rounding = amplification.carriedBound(0, end, acceleration_rounding) / size;
  ReplaySettings settings;
  settings.end = end;
  settings.tolerance = tolerance;
  settings.max_evaluations = enoughEvaluations(scenario, plannedStepRate(scenario.trajectory->duration()));
  const auto judge = [&] {
    return judgeBeside(growth, replaysBeside(scenario, torques, settings, size, length), size, end, rounding, units);
  };
  const Check first = judge();
  if (first.verdict != Verdict::fail || growth.halved_at.empty() || !second_look) return first;
  // A step may pass over what changes faster, a joint that turns about, at any tolerance.
  settings.stops = growth.halved_at;
  return judge();
}

}  // namespace ursula
