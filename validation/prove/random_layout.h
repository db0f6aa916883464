#pragma once

#include <array>

#include "model/manipulator.h"
#include "validation/prove/random_recipe.h"

namespace ursula {

/// Where one leg stands while the platform is in the middle of its motion; lengths in the machine's own.
struct LegPlace {
  Vector3d A, B;  ///< from the middle of the base, z from the base to the platform
  Vector3d axis;  ///< not of unit length
  double l = 1, s = 1;
  Knee knee = Knee::positive;
};
using Layout = std::array<LegPlace, leg_count>;

/// Six legs that reach their platform points: base and platform are drawn first, then links that close the triangle
/// A R B with an angle at the knee between 20° and 160°, beyond for one or two legs of a machine near a singularity.
Layout randomLayout(Dice& dice, const Recipe& recipe);

}  // namespace ursula
