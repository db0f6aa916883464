#pragma once

#include <Eigen/Geometry>
#include <array>

#include "model/mechanism.h"

namespace ursula {

/// Columns of the output body's pose in files.
inline constexpr std::array<const char*, 7> output_columns = {"output_x_m", "output_y_m", "output_z_m", "output_w",
                                                              "output_x",   "output_y",   "output_z"};

/// Returns the output body's own frame in the world, by its displacement from the reference pose.
inline Eigen::Isometry3d outputPose(const Mechanism& mechanism, const Eigen::Isometry3d& displacement) {
  return displacement * mechanism.bodies()[mechanism.output()].frame;
}

/// Returns the numbers of these columns; the quaternion has w >= 0.
inline std::array<double, 7> numbersOf(const Eigen::Isometry3d& pose) {
  Eigen::Quaterniond q(pose.linear());
  if (q.w() < 0) q.coeffs() *= -1;
  const Vector3d p = pose.translation();
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

}  // namespace ursula
