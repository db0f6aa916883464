#include "validation/replay/windowed_replay.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

constexpr double eps = Eigen::NumTraits<double>::epsilon();
/// The ends of a window from two integrators differ by rounding.
constexpr double same_instant = 1e-12;

}  // namespace

void LoopForces::include(const Conditioning& instant) { size = std::max(size, instant.force_scale); }

IntegrationError::At IntegrationError::at(double t) const {
  const auto after =
      std::lower_bound(steps.begin(), steps.end(), t, [](const At& each, double x) { return each.t < x; });
  if (after != steps.end()) return *after;
  if (!steps.empty() && t - steps.back().t <= same_instant * t) return steps.back();
  constexpr double none = std::numeric_limits<double>::infinity();
  return {t, none, none, none, none, none};
}

double measuredError(const WindowedReplay& window, double t, double IntegrationError::At::*part) {
  double out = 0;
  for (const IntegrationError* error : {&window.integration, &window.closer})
    if (error->measured()) out += integration_safety * (error->at(t).*part);
  return out;
}

IntegrationError integrationError(const Replay& fine, const Replay& coarse) {
  IntegrationError out;
  IntegrationError::At largest;
  const double reached = coarse.steps.empty() ? 0 : coarse.steps.back().t;
  // An error that should be 0 shows its size in longer steps, and its change in shorter ones.
  const auto shown = [shorter = coarse.accepted > fine.accepted](double other, double here) {
    return shorter ? larger(std::abs(other), std::abs(other - here)) : std::abs(other);
  };
  for (const ReplayStep& step : fine.steps) {
    if (step.t - reached > same_instant * step.t) break;
    const ReplayStep other = interpolated(coarse, step.t);
    largest.t = step.t;
    largest.position = larger(largest.position, (step.position_error - other.position_error).norm());
    largest.rotation = larger(largest.rotation, (step.rotation_error - other.rotation_error).norm());
    largest.gap = larger(largest.gap, shown(other.closure.position, step.closure.position));
    largest.gap_rate = larger(largest.gap_rate, shown(other.closure.velocity, step.closure.velocity));
    largest.energy = larger(largest.energy, shown(other.energy_error, step.energy_error));
    out.steps.push_back(largest);
  }
  return out;
}

double errorPerStep(double tolerance, double position_scale) {
  return std::sqrt(24.0) * (tolerance + eps) * (1 + position_scale);
}

double driftLimit(const GrowthWindow& window, double tolerance, double steps, double position_scale, double t) {
  const double per_step = errorPerStep(tolerance, position_scale);
  return window.bound(t, per_step * steps / (window.end() - window.start()), per_step);
}

double driftWithoutMeasured(const WindowedReplay& window, double position_scale, double t) {
  const double tolerance = window.integration.measured() ? 0 : window.replay.tolerance;
  return driftLimit(window.window, tolerance, static_cast<double>(window.replay.steps.size()), position_scale, t);
}

double replayLimit(const WindowedReplay& window, double position_scale, double t) {
  return driftWithoutMeasured(window, position_scale, t) + measuredError(window, t, &IntegrationError::At::position);
}

}  // namespace ursula
