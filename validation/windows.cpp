#include "validation/windows.h"

#include <algorithm>
#include <cmath>

namespace ursula {

double SampledLimit::operator()(double t) const {
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), t,
                                      [](const PointwiseSample& sample, double at) { return sample.motion.t < at; });
  const auto last = static_cast<std::ptrdiff_t>(samples_.size()) - 1;
  const auto i = static_cast<std::size_t>(std::min(after - samples_.begin(), last));
  return std::max(samples_[i].conditioning.accelerationRounding(),
                  samples_[i == 0 ? 0 : i - 1].conditioning.accelerationRounding());
}

double plannedStepRate(double duration) { return 128 / std::min(duration, 3.0); }

long enoughEvaluations(double step_rate, double duration) {
  return 20000 + static_cast<long>(4 * 13 * step_rate * duration);
}

double positionScale(const std::vector<PointwiseSample>& samples) {
  double scale = 0;
  for (const PointwiseSample& sample : samples) scale = std::max(scale, sample.conditioning.position_scale);
  return scale;
}

Amplification linearised(const Scenario& scenario) {
  return Amplification(scenario, std::max(300, static_cast<int>(std::ceil(40 * scenario.trajectory->duration()))));
}

std::vector<GrowthWindow> planWindows(const Scenario& scenario, const Amplification& amplification,
                                      const ReplayPlan& plan) {
  const double rate = plan.step_rate * errorPerStep(scenario.simulation.tolerance, plan.position_scale);
  // A quarter of what is useful: the steps taken, known only afterwards, may be more than planned.
  const double planned = useful_replay_limit / 4 * amplification.length();
  std::vector<GrowthWindow> windows;
  for (std::size_t first = 0; first + 1 < amplification.instants().size(); first = windows.back().last)
    windows.push_back(amplification.window(first, plan.acceleration, rate, planned));
  return windows;
}

double plannedBound(const Scenario& scenario, const ReplayPlan& plan, const GrowthWindow& window) {
  const double per_step = errorPerStep(scenario.simulation.tolerance, plan.position_scale);
  return window.bound(window.end(), plan.step_rate * per_step, 0);
}

std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const ReplayPlan& plan,
                                            const std::vector<GrowthWindow>& windows) {
  std::vector<WindowedReplay> replays;
  for (const GrowthWindow& window : windows) {
    ReplaySettings settings;
    settings.integrator = scenario.simulation.integrator;
    settings.tolerance = scenario.simulation.tolerance;
    settings.start = window.start();
    settings.end = window.end();
    settings.max_evaluations = plan.max_evaluations;
    replays.push_back({window, replay(scenario, plan.torques, settings)});
  }
  return replays;
}

std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const Amplification& amplification,
                                            const ReplayPlan& plan) {
  return replayInWindows(scenario, plan, planWindows(scenario, amplification, plan));
}

std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const ReplayPlan& plan) {
  return replayInWindows(scenario, linearised(scenario), plan);
}

}  // namespace ursula
