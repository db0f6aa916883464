#include "validation/mistakes/cause.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ursula {

Cause fixedCause(const CauseName& name,
                 std::function<std::vector<Vector6d>(const std::vector<Motion<double>>&)> torques) {
  Cause out{
      false,
      [torques = std::move(torques)](double, const std::vector<Motion<double>>& motions) { return torques(motions); },
      [text = name.text](double, double) { return text; }};
  if (name.named) out.named = [named = name.named](double, double) { return named; };
  return out;
}

std::string withDeviation(double value, double deviation) {
  const double size = std::abs(value);
  if (!(deviation > 1e-9 * size && std::isfinite(deviation))) return fmt::format("{:.9g} +- {:.1g}", value, deviation);
  const int place = static_cast<int>(std::floor(std::log10(deviation)));
  return fmt::format("{:.{}f} +- {:.1g}", value, std::clamp(-place, 0, 15), deviation);
}

}  // namespace ursula
