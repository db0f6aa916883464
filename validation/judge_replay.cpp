#include "validation/judge_replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "validation/worst.h"

namespace ursula {
namespace {

constexpr double eps = Eigen::NumTraits<double>::epsilon();

/// A value of one step with its limit.
struct Measure {
  std::string name, unit, what;
  std::function<double(const ReplayStep&)> value;
  std::function<double(const WindowedReplay&, const ReplayStep&)> limit;
  std::string basis;
  double useful = 0;  ///< a larger limit says nothing; 0 where any limit does
};

Worst worstOf(const std::vector<WindowedReplay>& windows, const Measure& measure) {
  Worst worst;
  for (const WindowedReplay& window : windows)
    for (const ReplayStep& step : window.replay.steps)
      worst.add(measure.value(step), measure.limit(window, step), step.t);
  return worst;
}

std::size_t stepsOf(const std::vector<WindowedReplay>& windows) {
  std::size_t steps = 0;
  for (const WindowedReplay& window : windows) steps += window.replay.steps.size();
  return steps;
}

Check judgeMeasure(const std::vector<WindowedReplay>& windows, const Measure& measure) {
  std::string unfinished;
  for (const WindowedReplay& window : windows) {
    if (window.replay.gave_up.empty()) continue;
    unfinished = fmt::format("the replay from t = {:.6g} s gave up: {}", window.window.start(), window.replay.gave_up);
    if (!window.replay.too_long) return notMade(measure.name, measure.unit, unfinished);
  }
  const Worst shown = worstOf(windows, measure);
  if (!shown.any) return notMade(measure.name, measure.unit, "no step was compared");
  const std::string where =
      windows.size() == 1 ? "open loop over the whole motion" : fmt::format("open loop in {} windows", windows.size());
  const std::string why = fmt::format("{}, {}, at {} steps; shown for t = {:.6g} s{}{}", measure.what, where,
                                      stepsOf(windows), shown.t, unfinished.empty() ? "" : "; ", unfinished);
  if (!unfinished.empty() && shown.value <= shown.limit)
    return notJudgeable(measure.name, shown.value, shown.limit, measure.unit, measure.basis, why);
  if (measure.useful > 0 && !(shown.limit <= measure.useful))
    return notJudgeable(
        measure.name, shown.value, shown.limit, measure.unit, measure.basis,
        why + fmt::format("; the limit exceeds {:.3g} {}, beyond which it says nothing", measure.useful, measure.unit));
  return judged(measure.name, shown.value, shown.limit, measure.unit, measure.basis, why);
}

double stepCount(const WindowedReplay& window) { return static_cast<double>(window.replay.steps.size()); }

double span(const WindowedReplay& window) { return window.window.end() - window.window.start(); }

}  // namespace

void LoopForces::include(const Conditioning& instant) {
  size = std::max(size, instant.force_scale);
  rounding = std::max(rounding, instant.gapRounding());
}

double errorPerStep(double tolerance, double position_scale) {
  return std::sqrt(24.0) * (tolerance + eps) * (1 + position_scale);
}

double driftLimit(const GrowthWindow& window, double tolerance, double steps, double position_scale, double t) {
  const double per_step = errorPerStep(tolerance, position_scale);
  return window.bound(t, per_step * steps / (window.end() - window.start()), per_step);
}

std::vector<Check> judgeReplay(const std::vector<WindowedReplay>& windows, double position_scale, double length,
                               const LoopForces& forces) {
  if (windows.empty()) return {notMade("replay.position", "m", "there was no replay")};
  const double per_step = errorPerStep(windows.front().replay.tolerance, position_scale);
  const auto drift = [position_scale](const WindowedReplay& window, const ReplayStep& step) {
    return driftLimit(window.window, window.replay.tolerance, stepCount(window), position_scale, step.t);
  };
  const std::string drift_basis = fmt::format(
      "pointwise acceleration limit and {:.3g} a step (sqrt(24) (tolerance {:.1g} + eps) (1 + coordinates)), carried "
      "to "
      "t by the variational equations, all aligned for the worst",
      per_step, windows.front().replay.tolerance);
  const auto opening = [per_step, forces](const WindowedReplay& window, const ReplayStep&) {
    return per_step * stepCount(window) * (1 + span(window)) + forces.rounding * span(window) * span(window) / 2;
  };
  const auto rate = [per_step, forces](const WindowedReplay& window, const ReplayStep&) {
    return per_step * stepCount(window) * (1 + span(window)) + forces.rounding * span(window);
  };
  const std::string opening_basis = fmt::format(
      "{:.3g} a step over all steps, x (1 + duration): loop errors are carried, not amplified; and {:.3g} m/s^2, the "
      "rounding of the forces that close the loops",
      per_step, forces.rounding);
  const double per_step_relative = per_step / (1 + position_scale);
  const std::vector<Measure> measures = {
      {"replay.position", "m", "P against the commanded path",
       [](const ReplayStep& step) { return step.position_error.norm(); }, drift, drift_basis,
       useful_replay_limit * length},
      {"replay.orientation", "rad", "orientation against the commanded one",
       [](const ReplayStep& step) { return step.rotation_error.norm(); },
       [drift, length](const WindowedReplay& window, const ReplayStep& step) { return drift(window, step) / length; },
       drift_basis, useful_replay_limit},
      {"closure.position", "m", "the six loops' gaps", [](const ReplayStep& step) { return step.closure.position; },
       opening, opening_basis},
      {"closure.velocity", "m/s", "the rates of the gaps", [](const ReplayStep& step) { return step.closure.velocity; },
       rate, opening_basis},
      {"energy.balance", "J", "kinetic and potential energy against the work of torques, friction and load",
       [](const ReplayStep& step) { return std::abs(step.energy_error); },
       [opening, per_step_relative, forces](const WindowedReplay& window, const ReplayStep& step) {
         return per_step_relative * stepCount(window) * window.replay.energy_scale +
                forces.size * opening(window, step);
       },
       fmt::format("{:.3g} a step x the energy's sensitivity to the state, and the work of the {:.3g} N that hold the "
                   "loops on gaps as wide as closure.position allows",
                   per_step_relative, forces.size)},
  };
  std::vector<Check> checks;
  checks.reserve(measures.size());
  for (const Measure& measure : measures) checks.push_back(judgeMeasure(windows, measure));
  return checks;
}

}  // namespace ursula
