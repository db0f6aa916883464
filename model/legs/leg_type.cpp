#include "model/legs/leg_type.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace ursula {

DeadCentre LegType::deadCentre(const Reach& reach) const {
  const double short_of = reach.most - reach.distance, beyond = reach.distance - reach.least;
  const bool straight = short_of < beyond;
  return {straight ? "is stretched straight" : "is folded flat",
          fmt::format("{} {:.6g} m {}, {:.3g} m from where its knee can bend neither way, and there its speed is not "
                      "determined",
                      reach.before, reach.distance, measuredFrom(), straight ? short_of : beyond)};
}

std::optional<LinkLengths> LegType::lengthsAtDeadCentre(const LegSpan& /*span*/, double /*angle*/) const {
  return std::nullopt;
}

double sideOfTriangle(double side, double angle, double ratio) {
  return side / std::sqrt(ratio * ratio + 1 - 2 * ratio * std::cos(angle));
}

const LegType& typeOf(LegKind kind) {
  constexpr std::array types = {ursLeg, upsLeg, rusLeg, pusLeg};  // in the order of LegKind
  static_assert(types.size() == leg_kind_count);
  return types[static_cast<std::size_t>(kind)]();
}

}  // namespace ursula
