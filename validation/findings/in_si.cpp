#include "validation/findings/findings.h"

#include <fmt/format.h>

namespace ursula {
namespace {

/// "p_x_m" → "m", "tau_1_Nm" → "Nm", "q_w" → "".
std::string unitOf(const std::string& column) {
  for (const char* unit : {"rad_s2", "rad_s", "rad", "m_s2", "m_s", "Nm", "N", "J", "m", "s"}) {
    const std::string ending = std::string("_") + unit;
    if (column.size() > ending.size() && column.compare(column.size() - ending.size(), ending.size(), ending) == 0)
      return unit;
  }
  const std::size_t open = column.rfind('(');
  return open == std::string::npos || column.back() != ')' ? "" : column.substr(open + 1, column.size() - open - 2);
}

void restoreColumns(const FrameChange& from, TimeSeries& series) {
  for (std::size_t k = 0; k < series.names.size(); ++k) {
    const std::string& column = series.names[k];
    const double unit = from.units.of(unitOf(column));
    double offset = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const char* prefix : {"p_", "sim_p_"})
        if (column == fmt::format("{}{}_m", prefix, "xyz"[axis])) offset = from.origin(axis);
    for (double& value : series.columns[k]) value = value * unit + offset;
  }
}

}  // namespace

void seriesInSi(const FrameChange& from, ValidationResult& result) {
  restoreColumns(from, result.timeseries);
  for (auto& [title, curve] : result.curves) restoreColumns(from, curve);
  for (Event& event : result.events) event.t *= from.units.time;
}

}  // namespace ursula
