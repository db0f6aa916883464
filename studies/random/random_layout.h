#pragma once

#include <vector>

#include "model/manipulator.h"
#include "studies/random/random_recipe.h"

namespace ursula {

/// Where one leg stands while the platform is in the middle of its motion; lengths in the machine's own.
struct LegPlace {
  Vector3d A, B;  ///< from the middle of the base, z from the base to the platform
  Vector3d axis;  ///< not of unit length
  double l = 1, s = 1;
  Knee knee = Knee::positive;
};
using Layout = std::vector<LegPlace>;

/// Legs that reach their platform points: base and platform are drawn first, then links that close what they have to
/// close. The triangle A R B of URS, or of RUS as seen along the axis, with an angle at the knee between 20° and 160°;
/// the rod of PUS at 20° to 70° to its rail; UPS within the middle 70 % of its stroke. Beyond for one or two legs of a
/// machine near a singularity, or near a stroke's end.
Layout randomLayout(Dice& dice, const Recipe& recipe);

/// The links of legs that stand.
void drawLinks(Dice& dice, const Recipe& recipe, Layout& layout);

}  // namespace ursula
