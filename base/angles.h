#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace ursula {

constexpr double pi = 3.14159265358979323846;
constexpr double degree = pi / 180;  ///< in rad
constexpr double degrees_per_radian = 180 / pi;

/// The angle between sides a and b of a triangle, opposite to c. It is exact to rounding even for needles (Kahan,
/// Miscalculating Area and Angles of a Needle-like Triangle, 2014, sect. 2).
inline double angleOpposite(double c, double a, double b) {
  if (a < b) std::swap(a, b);
  const double slack = b >= c ? c - (a - b) : b - (a - c);
  const double top = ((a - b) + c) * slack, bottom = (a + (b + c)) * ((a - c) + b);
  return 2 * std::atan2(std::sqrt(std::max(top, 0.0)), std::sqrt(std::max(bottom, 0.0)));
}

}  // namespace ursula
