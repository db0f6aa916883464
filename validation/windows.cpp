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

double positionScale(const std::vector<PointwiseSample>& samples) {
  double scale = 0;
  for (const PointwiseSample& sample : samples) scale = std::max(scale, sample.conditioning.position_scale);
  return scale;
}

std::vector<WindowedReplay> replayInWindows(const Scenario& scenario, const ReplayPlan& plan) {
  const double duration = scenario.trajectory->duration();
  const int intervals = std::max(300, static_cast<int>(std::ceil(40 * duration)));
  const Amplification amplification(scenario, intervals);
  const double rate = plan.step_rate * errorPerStep(scenario.simulation.tolerance, plan.position_scale);

  std::vector<WindowedReplay> windows;
  for (std::size_t first = 0; first + 1 < amplification.instants().size();) {
    WindowedReplay window;
    window.window =
        amplification.window(first, plan.acceleration, rate, useful_replay_limit * amplification.length());
    ReplaySettings settings;
    settings.integrator = scenario.simulation.integrator;
    settings.tolerance = scenario.simulation.tolerance;
    settings.start = window.window.start();
    settings.end = window.window.end();
    window.replay = replay(scenario, plan.torques, settings);
    first = window.window.last;
    windows.push_back(std::move(window));
  }
  return windows;
}

}  // namespace ursula
