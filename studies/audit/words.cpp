#include "studies/audit/words.h"

#include <fmt/format.h>

#include <cmath>

namespace ursula::audit {

std::string number(double value) {
  if (std::isnan(value)) return "—";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size < 1e-9) return fmt::format("{:.0e}", value);
  if (size < 999.5 || size >= 1e6) return fmt::format("{:.3g}", value);
  const double unit = size < 9995 ? 10 : size < 99950 ? 100 : 1000;  // three digits, written out
  return fmt::format("{:.0f}", std::round(value / unit) * unit);
}

std::string residualOf(double residual, const AuditRow& row) {
  if (std::isnan(residual)) return "—";
  const std::string unit = row.unit.empty() ? "" : " " + row.unit;
  if (row.size == 0) return number(residual) + unit;
  return fmt::format("{} of {}{}", number(residual), number(row.size), unit);
}

std::string instant(double t) { return t < 0 ? "never" : fmt::format("{:.3f} s", t); }

std::string ending(const AuditEffect& effect, double duration) {
  if (effect.replay_end < duration) return fmt::format("lost at {:.1f} s", effect.replay_end);
  return fmt::format("{:.2g} m", effect.end_deviation);
}

}  // namespace ursula::audit
