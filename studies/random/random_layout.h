#pragma once

#include <vector>

#include "model/manipulator.h"
#include "studies/random/random_recipe.h"

namespace ursula {

/// The place of one leg with the platform in the middle of its motion; lengths in the machine's own.
struct LegPlace {
  Vector3d A, B;  ///< relative to the middle of the base; z points from the base to the platform
  Vector3d axis;  ///< not of unit length
  double l = 1, s = 1;
  Knee knee = Knee::positive;
};
using Layout = std::vector<LegPlace>;

/// Legs that reach their platform points: base and platform are drawn first, then links that close the loops. The
/// triangle A R B of URS, or of RUS in the view along the axis, has a knee angle of 20° to 160°. The rod of PUS is at
/// 20° to 70° to its rail; UPS is within the middle 70 % of its stroke. One or two legs exceed this on machines near a
/// singularity or near a stroke's end.
Layout randomLayout(Dice& dice, const Recipe& recipe);

/// Draws the links of placed legs.
void drawLinks(Dice& dice, const Recipe& recipe, Layout& layout);

}  // namespace ursula
