#include "validation/replay/beside_path.h"

#include <algorithm>
#include <cmath>

#include "model/instants.h"
#include "validation/replay/windows.h"

namespace ursula {
namespace {

/// Deviations grow this many times over the time compared, or as often as they do at all.
constexpr double wanted_growth = 100;
/// A deviation at the end of that, over the machine's length: linear to its square.
constexpr double wanted_deviation = 1e-5;
/// So many that no step passes over a joint that turns about: what friction does there no error estimate has seen.
constexpr int stops_of_second_look = 257;

/// The last instant of the first window in which deviations have grown by no more than wanted, at least one interval.
std::size_t lastOf(const Amplification& amplification) {
  const auto none = [](double) { return 0.0; };
  const GrowthWindow window = amplification.window(0, none, 1, wanted_growth);  // no longer than it takes
  std::size_t last = 1;
  while (last + 1 < window.t.size() && window.from_start[last + 1] <= wanted_growth) ++last;
  return last;
}

Vector6d deviationAtEnd(const Replay& replay, double length) {
  Vector6d out;
  out << replay.steps.back().position_error, length * replay.steps.back().rotation_error;
  return out;
}

}  // namespace

BesidePath::BesidePath(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques,
                       const Amplification& amplification, const std::function<double(double)>& acceleration_rounding,
                       double tolerance)
    : scenario_(scenario),
      torques_(torques),
      tolerance_(tolerance),
      length_(amplification.length()),
      stiff_(isStiff(amplification, scenario.trajectory->duration())) {
  const std::size_t last = lastOf(amplification);
  // Fewer than the amplification's: an interval that these do not resolve is halved.
  intervals_ = std::max(1, static_cast<int>(last) / 4);
  end_ = amplification.instants()[last];
  right_ = growthOf(fastSubject(*scenario.manipulator, scenario.load).accelerations);
  size_ = wanted_deviation * length_ / std::max(1.0, right_.Phi.topRows<6>().norm());
  rounding_ = amplification.carriedBound(0, end_, acceleration_rounding) / size_;
}

/// No coordinate is special.
BesidePath::Vector12 BesidePath::direction() const {
  Vector12 out;
  for (int i = 0; i < 12; ++i) out(i) = std::cos(1.0 + 2.3 * i);
  return out.normalized();
}

Growth BesidePath::growthOf(const AccelerationUnder& accelerations) const {
  return ursula::growthOf(scenario_, accelerations, end_, intervals_);
}

EndsBeside BesidePath::replayed(const std::vector<double>& stops, double size) const {
  ReplaySettings settings;
  settings.end = end_;
  settings.stops = stops;
  settings.stiff = stiff_;
  constexpr long evaluations_per_stop = 40;  // Fehlberg's pair takes 13 a step
  settings.max_evaluations = enoughEvaluations(scenario_, plannedStepRate(scenario_.trajectory->duration())) +
                             evaluations_per_stop * static_cast<long>(stops.size());
  EndsBeside out;
  out.size = size;
  const auto endOf = [&](double share, double finer_by) {
    settings.deviation = share * size * direction();
    settings.tolerance = tolerance_ / finer_by;
    const Replay run = replay(scenario_, torques_, settings);
    if (run.gave_up.empty() && !run.left_path && !run.steps.empty()) return deviationAtEnd(run, length_);
    if (out.gave_up.empty()) out.gave_up = "the replay from beside the path gave up: " + run.gave_up;
    return Vector6d(Vector6d::Constant(std::nan("")));
  };
  out.on_path = endOf(0, 1);
  out.above = endOf(0.5, 1);
  out.below = endOf(-0.5, 1);
  out.whole_apart = endOf(1, coarser) - endOf(-1, coarser);
  return out;
}

const EndsBeside& BesidePath::ends() const {
  return ends_.get([this] { return replayed({}, size_); });
}

const EndsBeside& BesidePath::endsWithStops() const {
  return ends_with_stops_.get([this] {
    std::vector<double> stops = equallySpaced(end_, stops_of_second_look);
    const std::size_t stride = 1 + right_.halved_at.size() / stops_of_second_look;
    for (std::size_t k = 0; k < right_.halved_at.size(); k += stride) stops.push_back(right_.halved_at[k]);
    return replayed(stops, size_ / 10);
  });
}

}  // namespace ursula
