#pragma once

#include <array>

#include "base/scalar.h"

namespace ursula {

/// Forces and moments that one leg's joints exert on the body nearer to the platform, at the joint's point; in B, N and
/// N·m. The moments include constraint moments, motor torque and friction.
struct LegReactions {
  Vector3d f_A = Vector3d::Zero(), n_A = Vector3d::Zero();  ///< base on proximal link, at A
  Vector3d f_R = Vector3d::Zero(), n_R = Vector3d::Zero();  ///< proximal on distal link, at R
  Vector3d f_B = Vector3d::Zero();                          ///< distal link on platform, at B
};

using Reactions = std::array<LegReactions, leg_count>;

}  // namespace ursula
