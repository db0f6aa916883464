#pragma once

#include <Eigen/Core>

#include "base/scalar.h"

namespace ursula {

/// An angle in radians, correctly rounded.
double radians(double degrees);

/// Returns the unit quaternion [w, x, y, z] of roll, pitch and yaw in degrees. They are rotations about the fixed axes
/// x, y, z of B in this order, Q = R_z(yaw) R_y(pitch) R_x(roll). Each entry is correctly rounded.
Eigen::Vector4d quaternionOf(const Vector3d& roll_pitch_yaw);

}  // namespace ursula
