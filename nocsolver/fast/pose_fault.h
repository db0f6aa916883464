#pragma once

#include <cstdint>

namespace ursula {

/// Why a pose of a batch has no answer; of several, the first on the way from leg 1 on.
enum class PoseFault : std::uint8_t {
  none,
  out_of_reach,
  end_of_stroke,
  point_on_axis,
  stretched_leg,
  singular_jacobian,
  not_finite  ///< the answer is: numbers of pose, efforts or load are too large, too small or NaN
};

}  // namespace ursula
