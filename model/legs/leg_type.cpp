#include "model/legs/leg_type.h"

#include <fmt/format.h>

#include <cmath>

namespace ursula {

DeadCentre LegType::deadCentre(const Reach& reach) const {
  const double short_of = reach.most - reach.distance, beyond = reach.distance - reach.least;
  const bool straight = short_of < beyond;
  return {
      straight ? "is stretched straight" : "is folded flat",
      fmt::format(
          "{} {:.6g} m {}, {:.3g} m from where its knee can bend neither way, and there its speed is not determined",
          reach.before, reach.distance, measuredFrom(), straight ? short_of : beyond)};
}

std::optional<LinkLengths> LegType::lengthsAtDeadCentre(const LegSpan& /*span*/, double /*angle*/) const {
  return std::nullopt;
}

LegSpan spanOf(const Vector3d& u, const Vector3d& AB) {
  const double along = u.dot(AB);
  return {AB.norm(), std::abs(along), (AB - along * u).norm()};
}

std::array<double, 2> directionOf(const Matrix3d& frame, const Vector3d& AB) {
  const Vector3d x = frame.col(0), u = frame.col(1), across = u.cross(AB);
  return {std::atan2(-across.dot(u.cross(x)), across.dot(x)), std::atan2(across.norm(), u.dot(AB))};
}

double sideOfTriangle(double side, double angle, double ratio) {
  return side / std::sqrt(ratio * ratio + 1 - 2 * ratio * std::cos(angle));
}

}  // namespace ursula
