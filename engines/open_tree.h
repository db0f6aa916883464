#pragma once

#include <array>
#include <vector>

#include "model/motion.h"

namespace ursula {

/// The coordinates of an engine's trees, rates and accelerations, in the engine's own order and frames: what its user
/// begins with once the platform's motion has been brought onto the joints.
struct TreeCoordinates {
  Motion<double> motion;  ///< of the platform, that they belong to
  std::vector<double> q, u, u_dot;
};

/// What an engine says of the machine cut open at the platform's joints: legs of three coordinates each, a free
/// platform. Closed where J u_leg = P u_platform; the platform's six speeds are the engine's choice. Places of legs
/// that a machine has not stay empty.
struct OpenTree {
  using PointMap = Eigen::Matrix<double, 3, 6>;

  struct Leg {
    Matrix3d J = Matrix3d::Zero();      ///< velocity of the leg's point for unit rates of its coordinates
    PointMap P = PointMap::Zero();      ///< of the platform's for unit speeds, in the same axes
    Vector3d force = Vector3d::Zero();  ///< M u̇ + bias − what acts, on the leg's coordinates
  };

  std::array<Leg, leg_count> legs;
  Vector6d force = Vector6d::Zero();  ///< the same on the platform's speeds
};

/// What direct dynamics need besides; the forces of the OpenTree are then those at u̇ = 0.
struct OpenTreeMasses {
  std::array<Matrix3d, leg_count> legs;
  std::array<Vector3d, leg_count> drift;  ///< acceleration of the platform's point less that of the leg's, at u̇ = 0
  Matrix6d platform;
};

}  // namespace ursula
