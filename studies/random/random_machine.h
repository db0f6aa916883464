#pragma once

#include "model/trajectory.h"
#include "studies/random/random_layout.h"

namespace ursula {

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

/// Exactly zero, or of the recipe's size.
Vector3d randomGravity(Dice& dice, const Recipe& recipe);

}  // namespace ursula
