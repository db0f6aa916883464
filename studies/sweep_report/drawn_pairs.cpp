#include "studies/sweep_report/sweep_outputs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ursula {
namespace {

struct Pair {
  std::size_t parameter, output;
  double strength;
};

/// Whether a scatter plot of the output says something: one with two values does not, and each check has its own plot.
bool saysMore(OutputKind kind) { return kind != OutputKind::not_passed && kind != OutputKind::largest_share; }

/// The primary output's pairs first, the strongest first.
std::vector<Pair> sortedPairs(const SweepSummary& summary) {
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < summary.outputs.size(); ++k)
    for (std::size_t p = 0; p < summary.parameters.size(); ++p)
      if (const double s = strength(summary.outputs[k].relations[p]); s > 0 && saysMore(summary.outputs[k].kind))
        pairs.push_back({p, k, s});
  std::stable_sort(pairs.begin(), pairs.end(), [&summary](const Pair& a, const Pair& b) {
    const bool first_a = a.output == summary.primary, first_b = b.output == summary.primary;
    return first_a != first_b ? first_a : a.strength > b.strength;
  });
  return pairs;
}

}  // namespace

std::vector<Scatter> pairsToDraw(const SweepSummary& summary, std::size_t most) {
  std::vector<std::size_t> of_parameter(summary.parameters.size()), of_output(summary.outputs.size());
  std::vector<Scatter> out;
  for (const Pair& pair : sortedPairs(summary)) {
    const std::size_t outputs = pair.output == summary.primary ? 2 : 1;
    if (of_output[pair.output] >= outputs || of_parameter[pair.parameter] >= 2) continue;
    ++of_output[pair.output], ++of_parameter[pair.parameter];
    out.push_back({pair.parameter, pair.output, {}, {}});
    if (out.size() == most) break;
  }
  return out;
}

std::vector<std::size_t> rowsToDraw(std::size_t rows) {
  constexpr double golden = 0.6180339887498949;
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < std::min(rows, most_scattered); ++k) {
    const double at = golden * static_cast<double>(k);
    out.push_back(rows <= most_scattered ? k
                                         : static_cast<std::size_t>((at - std::floor(at)) * static_cast<double>(rows)));
  }
  return out;
}

std::vector<std::size_t> outputsToMap(const SweepSummary& summary, std::size_t most) {
  std::vector<std::size_t> out;
  const auto add = [&](auto wanted) {
    for (std::size_t k = 0; k < summary.outputs.size(); ++k)
      if (wanted(summary.outputs[k].kind) && !summary.outputs[k].spread.constant && out.size() < most) out.push_back(k);
  };
  add([](OutputKind kind) { return kind == OutputKind::largest_effort || kind == OutputKind::largest_share; });
  if (summary.primary < summary.outputs.size() && !summary.outputs[summary.primary].spread.constant &&
      std::find(out.begin(), out.end(), summary.primary) == out.end())
    out.push_back(summary.primary);
  add([](OutputKind kind) {
    return kind == OutputKind::kappa || kind == OutputKind::sine || kind == OutputKind::other;
  });
  return out;
}

std::vector<double> onGrid(const std::vector<double>& x_levels, const std::vector<double>& y_levels,
                           const std::vector<double>& x, const std::vector<double>& y,
                           const std::vector<double>& values) {
  std::vector<double> out(x_levels.size() * y_levels.size(), std::numeric_limits<double>::quiet_NaN());
  const auto place = [](const std::vector<double>& levels, double value) {
    return static_cast<std::size_t>(std::lower_bound(levels.begin(), levels.end(), value) - levels.begin());
  };
  for (std::size_t k = 0; k < values.size(); ++k)
    out[place(y_levels, y[k]) * x_levels.size() + place(x_levels, x[k])] = values[k];
  return out;
}

}  // namespace ursula
