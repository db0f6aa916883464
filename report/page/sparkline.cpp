#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "report/page/plots.h"
#include "report/text/quantity.h"
#include "report/text/text.h"

namespace ursula::report {
namespace {

constexpr std::size_t steps = 40;
constexpr double line_width = 100, line_height = 22;

/// Whether the line shows a value: an error starts at zero, which has no decade.
bool takes(double value) { return std::isfinite(value) && value > 0; }

}  // namespace

std::vector<double> trendOf(const TimeSeries& series) {
  const std::vector<double>* errors = series.find("error_p_m");
  if (errors == nullptr || errors->empty()) return {};
  const std::size_t rows = errors->size(), count = std::min(rows, steps);
  std::vector<double> trend;
  for (std::size_t k = 0; k < count; ++k) {
    double most = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = k * rows / count; i < (k + 1) * rows / count; ++i)
      if (std::isfinite((*errors)[i])) most = std::fmax(most, std::abs((*errors)[i]));
    trend.push_back(most);
  }
  return trend;
}

std::string sparkline(const std::vector<double>& trend) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const double value : trend)
    if (takes(value)) low = std::min(low, value), high = std::max(high, value);
  if (high == 0) return "";
  // The height is at least a decade, so small changes do not look large.
  const double bottom = std::min(std::log10(low), std::log10(high) - 1), span = std::log10(high) - bottom;
  std::string d;
  bool pen_down = false;
  for (std::size_t k = 0; k < trend.size(); ++k) {
    if (takes(trend[k]))
      d += fmt::format(
          "{}{:.1f} {:.1f}", pen_down ? "L" : "M",
          line_width * static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(trend.size() - 1, 1)),
          line_height - 2 - (line_height - 4) * (std::log10(trend[k]) - bottom) / span);
    pen_down = takes(trend[k]);
  }
  return fmt::format(
      "<svg class=\"spark\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"Replay error along the motion, "
      "from {} to {}\"><path d=\"{}\"/></svg>",
      line_width, line_height, escaped(quantity(low, "m")), escaped(quantity(high, "m")), d);
}

}  // namespace ursula::report
