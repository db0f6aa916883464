#pragma once

#include <cstdint>

namespace ursula {

/// Why a pose of a batch has no answer; the first fault, in the order of the legs.
enum class PoseFault : std::uint8_t {
  none,
  out_of_reach,
  end_of_stroke,
  point_on_axis,
  stretched_leg,
  singular_jacobian,
  not_finite  ///< pose, efforts or load are too large, too small or NaN for a finite answer
};

}  // namespace ursula
