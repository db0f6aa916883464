#pragma once

// SimTK's types as Eigen's and back; only sources of this folder include it. Never write `using namespace SimTK` here,
// because it breaks Eigen's comparisons.

#include <Simbody.h>

#include <Eigen/Core>

#include "base/scalar.h"

namespace ursula {

inline SimTK::Vec3 toSimTK(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Vector3d toEigen(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

inline SimTK::Rotation toSimTK(const Matrix3d& R) {
  // trustMe: re-orthogonalising would change the given pose.
  return SimTK::Rotation(SimTK::Mat33(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
                         true);
}

inline Matrix3d toEigen(const SimTK::Rotation& R) {
  Matrix3d out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out(i, j) = R[i][j];
  return out;
}

/// Returns [ω; v] or [n; f].
inline Vector6d toEigen(const SimTK::SpatialVec& v) {
  Vector6d out;
  out << toEigen(v[0]), toEigen(v[1]);
  return out;
}

inline Eigen::Map<const Eigen::VectorXd> mapped(const SimTK::Vector& v) {
  return {v.size() > 0 ? &v[0] : nullptr, v.size()};
}

}  // namespace ursula
