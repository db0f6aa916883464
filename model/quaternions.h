#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/scalar.h"
#include "model/motion.h"

namespace ursula {

/// Returns orientations of M in B as unit quaternions [w, x, y, z], as the output files give them. The first has w ≥ 0;
/// each other has the sign nearer to its predecessor.
std::vector<Eigen::Vector4d> quaternions(const std::vector<Motion<double>>& motions);

/// Returns the unit quaternion of the same rotation whose first entry other than 0 is positive.
inline Eigen::Vector4d withPositiveW(const Eigen::Vector4d& q) {
  for (int k = 0; k < 4; ++k)
    if (q(k) != 0) return q(k) < 0 ? Eigen::Vector4d(-q) : q;
  return q;
}

/// Returns an angle in radians, correctly rounded.
double radians(double degrees);

/// Returns the unit quaternion [w, x, y, z] of roll, pitch and yaw in degrees. They are rotations about the fixed axes
/// x, y, z of B in this order, Q = R_z(yaw) R_y(pitch) R_x(roll). Each entry is correctly rounded.
Eigen::Vector4d quaternionOf(const Vector3d& roll_pitch_yaw);

}  // namespace ursula
