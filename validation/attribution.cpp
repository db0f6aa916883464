#include "validation/attribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/worst.h"

namespace ursula {
namespace {

const WindowedReplay& mostAmplified(const std::vector<WindowedReplay>& windows) {
  return *std::max_element(windows.begin(), windows.end(), [](const WindowedReplay& a, const WindowedReplay& b) {
    return a.window.from_start.back() < b.window.from_start.back();
  });
}

/// The largest share of its rounding limit that the torque error reaches: the bound from that limit scales with it.
double torqueShare(const std::vector<PointwiseSample>& samples) {
  double share = 0;
  for (const PointwiseSample& sample : samples)
    if (sample.torque.error != 0) share = larger(share, sample.torque.error / sample.torque.limit);
  return share;
}

}  // namespace

ErrorBudget attribute(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                      const Ladder& ladder, const std::vector<Check>& checks) {
  ErrorBudget budget;
  const bool limit_too_large = std::any_of(checks.begin(), checks.end(), [](const Check& check) {
    return check.verdict == Verdict::inconclusive && check.name.rfind("replay.", 0) == 0;
  });
  if (windows.empty()) {  // no replay to look at
    budget.dominant = limit_too_large && overall(checks) != Verdict::fail ? "amplification" : "model";
    return budget;
  }
  const WindowedReplay& window = mostAmplified(windows);
  budget.amplification = window.window.from_start.back();
  budget.model = torqueShare(samples) * window.window.from_acceleration.back();
  budget.integration = ladder.extrapolated;
  double gap = 0;
  for (const ReplayStep& step : window.replay.steps) gap = larger(gap, step.closure.position);
  budget.closure = gap * budget.amplification;
  for (const WindowedReplay& each : windows)
    if (!each.replay.steps.empty()) budget.observed = larger(budget.observed, each.replay.maxPositionError());

  if (limit_too_large)
    budget.dominant = "amplification";
  else if (std::isnan(budget.model) || (budget.model >= budget.integration && budget.model >= budget.closure))
    budget.dominant = "model";
  else
    budget.dominant = budget.integration >= budget.closure ? "integration" : "closure";
  return budget;
}

void addBudget(const ErrorBudget& budget, ValidationResult& result) {
  result.findings.emplace_back("dominant error", budget.dominant);
  if (budget.amplification == 0) return;  // nothing was replayed
  result.findings.emplace_back("replay, largest position error", fmt::format("{:.3g} m", budget.observed));
  result.findings.emplace_back("bound of the model's share", fmt::format("{:.3g} m", budget.model));
  result.findings.emplace_back("integration's share, extrapolated", fmt::format("{:.3g} m", budget.integration));
  result.findings.emplace_back("bound of the closure's share", fmt::format("{:.3g} m", budget.closure));
  result.findings.emplace_back("amplification of a deviation at the start",
                               fmt::format("{:.4g}", budget.amplification));
}

}  // namespace ursula
