#pragma once

#include <array>
#include <vector>

#include "model/motion.h"

namespace ursula {

/// Coordinates of an engine's trees with rates and accelerations, in the engine's order and frames. They are the input
/// of an engine's calls, found from the platform's motion.
struct TreeCoordinates {
  Motion<double> motion;  ///< the platform's motion that they belong to
  std::vector<double> q, u, u_dot;
};

/// An engine's results for the machine opened at the platform's joints: legs with three coordinates each and a free
/// platform. The loops close if J u_leg = P u_platform; the engine chooses the platform's six speeds. The places of
/// missing legs stay empty.
struct OpenTree {
  using PointMap = Eigen::Matrix<double, 3, 6>;

  struct Leg {
    Matrix3d J = Matrix3d::Zero();      ///< velocity of the leg's point per unit rates of its coordinates
    PointMap P = PointMap::Zero();      ///< velocity of the platform's point per unit speeds, in the same axes
    Vector3d force = Vector3d::Zero();  ///< M u̇ + bias − applied forces, on the leg's coordinates
  };

  PerLeg<Leg> legs;
  Vector6d force = Vector6d::Zero();  ///< the same for the platform's speeds
};

/// Further quantities for direct dynamics; the forces of the OpenTree are then those at u̇ = 0.
struct OpenTreeMasses {
  PerLeg<Matrix3d> legs;
  PerLeg<Vector3d> drift;  ///< acceleration of the platform's point minus that of the leg's, at u̇ = 0
  Matrix6d platform;
};

}  // namespace ursula
