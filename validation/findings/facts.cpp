#include "validation/findings/findings.h"

#include <fmt/format.h>

#include <algorithm>

#include "validation/verdict/worst_share.h"

namespace ursula {
namespace {

/// The largest κ(B), which is infinite at a singular pose.
std::string nearestToSingular(const std::vector<PointwiseSample>& samples, const Units& units) {
  const PointwiseSample& at = *std::max_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.conditioning.kappa_B < b.conditioning.kappa_B;
  });
  return fmt::format("{:.4g}, at t = {:.6g} s", at.conditioning.kappa_B, at.motion.t * units.time);
}

/// The smallest |sin θ|, which is 0 if a leg is stretched or folded; none where no leg has a knee.
std::vector<std::pair<std::string, std::string>> nearestToEdge(const std::vector<PointwiseSample>& samples,
                                                               const Units& units) {
  const PointwiseSample& at = *std::min_element(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.conditioning.smallest_sine < b.conditioning.smallest_sine;
  });
  if (!(at.conditioning.smallest_sine < 1)) return {};
  return {{"smallest |sin theta|", fmt::format("{:.4g}, leg {} at t = {:.6g} s", at.conditioning.smallest_sine,
                                               at.conditioning.smallest_sine_leg + 1, at.motion.t * units.time)}};
}

void addStopped(const std::vector<WindowedReplay>& windows, const Units& units, ValidationResult& result) {
  for (const WindowedReplay& window : windows) {
    const Replay& replay = window.replay;
    if (replay.gave_up.empty() && !replay.left_path) continue;
    const double t = replay.left_path && !replay.steps.empty() ? replay.steps.back().t : replay.stopped_at;
    const std::string why = replay.left_path ? "P was off by more than the platform's size" : replay.gave_up;
    result.findings.emplace_back("replay stopped", fmt::format("stopped at t = {:.6g} s: {}", t * units.time, why));
  }
}

void addReplayed(const std::vector<WindowedReplay>& windows, const Units& units, ValidationResult& result) {
  long evaluations = 0;
  std::size_t steps = 0;
  double growth = 0;
  for (const WindowedReplay& window : windows) {
    evaluations += window.replay.evaluations;
    steps += window.replay.steps.size() - (window.replay.steps.empty() ? 0 : 1);
    for (double value : window.window.growth) growth = std::max(growth, value);
  }
  const auto add = [&result](const char* what, const std::string& text) { result.findings.emplace_back(what, text); };
  add("replay tolerance", fmt::format("{:.3g}", windows.front().replay.tolerance));
  add("replay windows", fmt::format("{}", windows.size()));
  add("replay steps", fmt::format("{}", steps));
  add("replay derivative evaluations", fmt::format("{}", evaluations));
  add("growth of a velocity deviation in a window", fmt::format("{:.4g} m/(m/s)", growth * units.time));
}

}  // namespace

void addFindings(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                 ValidationResult& result, const Units& units) {
  result.replay_windows = windows.size();
  if (samples.empty()) return;  // time ran out before the samples
  double acceleration = 0, acceleration_error = 0;
  for (const PointwiseSample& sample : samples) {
    const double length = sample.conditioning.length;
    acceleration = std::max(acceleration, sample.motion.p_ddot.norm() + length * sample.motion.omega_dot.norm());
    acceleration_error = larger(acceleration_error, sample.acceleration.error);
  }
  addStopped(windows, units, result);
  std::vector<std::pair<std::string, std::string>> findings = {
      {"largest platform acceleration", fmt::format("{:.6g} m/s^2", acceleration * units.acceleration())},
      {"acceleration error, relative to the largest",
       acceleration > 0 ? fmt::format("{:.3g}", acceleration_error / acceleration) : "none commanded"},
      {"largest condition number of B", nearestToSingular(samples, units)},
  };
  const auto edge = nearestToEdge(samples, units);
  findings.insert(findings.end(), edge.begin(), edge.end());
  result.findings.insert(result.findings.end(), findings.begin(), findings.end());
  if (!windows.empty()) addReplayed(windows, units, result);
}

}  // namespace ursula
