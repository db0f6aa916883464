#include "validation/limits/motion_sizes.h"

#include <algorithm>
#include <limits>

#include "model/instants.h"

namespace ursula {
namespace {

/// Enough to meet a move in a thousandth of the motion's time.
constexpr int tried_instants = 4097;

/// The conditioning of a motion across the whole machine within `duration`: of the size below which nothing moves.
Conditioning slowly(Conditioning at, double duration) {
  at.twist_scale = at.position_scale / duration;
  at.rate_scale = at.platform_rate = at.twist_scale / duration;
  at.effort = at.effort_scale * at.rate_scale;
  at.force_scale = at.reaction = at.largest_mass * at.rate_scale;
  return at;
}

}  // namespace

std::vector<double> tellingInstants(const Scenario& scenario) {
  const double duration = scenario.trajectory->duration();
  double fastest = 0, jerkiest = 0, speed = 0, acceleration = 0;
  for (const double t : equallySpaced(duration, tried_instants)) {
    const Motion<double> motion = scenario.trajectory->at(t);
    const double moves = motion.p_dot.norm() + motion.omega.norm(),
                 speeds_up = motion.p_ddot.norm() + motion.omega_dot.norm();
    if (moves > speed) speed = moves, fastest = t;
    if (speeds_up > acceleration) acceleration = speeds_up, jerkiest = t;
  }
  std::vector<double> out = equallySpaced(duration, instants_along);
  out.insert(out.end(), {fastest, jerkiest});
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

MotionSizes::MotionSizes(const Scenario& scenario, const Deadline& deadline) {
  ConditioningProbe probe(*scenario.manipulator, scenario.load);
  constexpr double eps = std::numeric_limits<double>::epsilon();
  RoundingLevels least = uniformLevels(0);
  const auto include = [](RoundingLevels& sizes, const Conditioning& at) {
    for (std::size_t q = 0; q < rounded_count; ++q) sizes[q] = std::max(sizes[q], at.size(static_cast<Rounded>(q)));
  };
  for (const double t : tellingInstants(scenario)) {
    deadline.require();
    const Conditioning at = probe.at(scenario.trajectory->at(t));
    include(sizes_, at);
    include(least, slowly(at, scenario.trajectory->duration()));
  }
  for (std::size_t q = 0; q < rounded_count; ++q) {
    if (sizes_[q] <= rounding_depth * eps * least[q]) sizes_[q] = 0;  // what roundings add up to is no motion
    floors_[q] = eps * (sizes_[q] > 0 ? sizes_[q] : least[q]);
  }
}

}  // namespace ursula
