#pragma once

#include <array>
#include <cstddef>

#include "base/real50.h"

namespace ursula {

/// Evaluates a quintic over s in [0, 1] by de Casteljau's rule from its control points. The model sums powers of s, so
/// the two share no formula.
inline Real50 atControlPoints(std::array<Real50, 6> points, const Real50& s) {
  for (std::size_t level = 5; level > 0; --level)
    for (std::size_t i = 0; i < level; ++i) points[i] += s * (points[i + 1] - points[i]);
  return points[0];
}

/// Value, rate and acceleration at one end of a quintic.
struct QuinticEnd {
  Real50 value, rate, acceleration;
};

/// The control points of the quintic with these ends, `h` apart: each end's derivatives determine the three nearest.
inline std::array<Real50, 6> controlPoints(const QuinticEnd& from, const QuinticEnd& to, const Real50& h) {
  return {from.value,
          from.value + h * from.rate / 5,
          from.value + 2 * h * from.rate / 5 + h * h * from.acceleration / 20,
          to.value - 2 * h * to.rate / 5 + h * h * to.acceleration / 20,
          to.value - h * to.rate / 5,
          to.value};
}

}  // namespace ursula
