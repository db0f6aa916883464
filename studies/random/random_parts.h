#pragma once

#include <memory>
#include <vector>

#include "model/load.h"
#include "model/manipulator.h"
#include "model/trajectory.h"
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

/// A machine and the platform pose about which it shall move.
struct Design {
  ManipulatorParameters machine;
  Vector3d position = Vector3d::Zero();  ///< position of P in the middle of the motion, in B
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vector3d middle = Vector3d::Zero();  ///< centre of the platform's points, in M
  HelixParameters helix;               ///< a helix with the pose at its middle, if the motion is a helix
};

Design randomDesign(Dice& dice, const Recipe& recipe);

/// Draws masses, mass centres, inertias and friction for the machine's points and lengths. Friction is a share of m a
/// L, the torque of the weight on a leg.
void drawBodies(Dice& dice, const Recipe& recipe, const Vector3d& middle, ManipulatorParameters& machine);

/// Returns a gravity of exactly zero or of the recipe's size.
Vector3d randomGravity(Dice& dice, const Recipe& recipe);

/// A motion of the recipe's kind about the design's pose. `share` makes it smaller if the legs cannot follow. Throws
/// InvalidParameter if the spline between the poses overshoots too far.
std::shared_ptr<const Trajectory> randomMotion(Dice& dice, const Recipe& recipe, const Design& design, double share);

/// Returns null if the recipe has no load.
std::shared_ptr<const Load> randomLoad(Dice& dice, const Recipe& recipe, const Design& design);

}  // namespace ursula
