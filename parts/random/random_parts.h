#pragma once

#include <memory>
#include <vector>

#include "model/load.h"
#include "model/manipulator.h"
#include "model/trajectory.h"
#include "parts/random/random_recipe.h"

namespace ursula {

/// A machine and the platform pose about which it shall move.
struct Design {
  ManipulatorParameters machine;
  Vector3d position = Vector3d::Zero();  ///< position of P in the middle of the motion, in B
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vector3d middle = Vector3d::Zero();  ///< centre of the platform's points, in M
  HelixParameters helix;               ///< a helix with the pose at its middle, if the motion is a helix
};

Design randomDesign(Dice& dice, const RandomRecipe& recipe);

/// Draws masses, mass centres, inertias and friction for the machine's points and lengths. Friction is a share of m a
/// L, the torque of the weight on a leg.
void drawBodies(Dice& dice, const RandomRecipe& recipe, const Vector3d& middle, ManipulatorParameters& machine);

/// A motion of the recipe's kind about the design's pose. `share` makes it smaller if the legs cannot follow. Throws
/// InvalidParameter if the spline between the poses overshoots too far.
std::shared_ptr<const Trajectory> randomMotion(Dice& dice, const RandomRecipe& recipe, const Design& design,
                                               double share);

/// Returns null if the recipe has no load.
std::shared_ptr<const Load> randomLoad(Dice& dice, const RandomRecipe& recipe, const Design& design);

}  // namespace ursula
