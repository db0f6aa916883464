#pragma once

#include "nocsolver/legs/leg_model.h"
#include "nocsolver/poses/direct_kinematics_roots.h"

// The six planes Πᵢ in which the motors hold the points Bᵢ. Internal to nocsolver/direct_kinematics*.

namespace ursula::direct {

/// A pose in Newton's method.
struct PlacedPlatform {
  Vector3d p;
  Eigen::Vector4d q;  ///< unit, [w, x, y, z]
};

/// Rotation matrix of a unit quaternion [w, x, y, z].
Matrix3d rotation(const Eigen::Vector4d& q);

/// The three quadrics that remain of the planes without p, and the quality of the elimination.
struct Elimination {
  ThreeQuadrics quadrics;
  double normals = 0;       ///< pivot ratio of X: 0 if the xᵢ do not span space, so that p is free
  double independence = 0;  ///< pivot ratio of the quadrics: 0 if they are dependent
};

class Planes {
 public:
  /// The planes for finite φ, rad.
  Planes(const MachineParameters<double>& model, const Vector6d& phi);

  const Vector3d& x(int i) const { return x_[static_cast<std::size_t>(i)]; }  ///< xᵢ, normal to Πᵢ, in B
  const Vector3d& z(int i) const { return z_[static_cast<std::size_t>(i)]; }  ///< zᵢ, in Πᵢ across the axis

  /// xᵢᵀ(p + Qbᵢ − aᵢ), m.
  Vector6d mismatch(const PlacedPlatform& pose) const;

  /// Bound of the rounding error in `mismatch` at an exact pose, m.
  double rounding(const PlacedPlatform& pose) const;

  /// Takes one Newton step on the mismatch; returns its size, m. `orientation` becomes the sign of det B.
  double newtonStep(const Vector6d& mismatch, PlacedPlatform& pose, int& orientation) const;

  Elimination eliminateP() const;

  /// The p that fits all planes best for the quaternion q.
  Vector3d p(const Eigen::Vector4d& q) const;

 private:
  Eigen::Matrix<double, leg_count, 3> normals() const;

  const MachineParameters<double>& model_;
  std::array<Vector3d, leg_count> x_, z_;
  double size_ = 0;  // largest ‖aᵢ‖, m
};

}  // namespace ursula::direct
