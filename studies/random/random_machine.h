#pragma once

#include "model/trajectory.h"
#include "studies/random/random_layout.h"

namespace ursula {

/// A machine and the pose of its platform about which it is to move.
struct Design {
  ManipulatorParameters machine;
  Vector3d position = Vector3d::Zero();  ///< of P in the middle of the motion, in B
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vector3d middle = Vector3d::Zero();  ///< of the platform's points, in M
  HelixParameters helix;               ///< whose middle the pose is, where the motion is a helix
};

Design randomDesign(Dice& dice, const Recipe& recipe);

/// Masses, mass centres, inertias and friction for the machine's points and lengths. Friction takes its share of
/// m a L, the torque of the weight that a leg carries.
void drawBodies(Dice& dice, const Recipe& recipe, const Vector3d& middle, ManipulatorParameters& machine);

/// Exactly zero, or of the recipe's size.
Vector3d randomGravity(Dice& dice, const Recipe& recipe);

}  // namespace ursula
