#pragma once

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "parts/poses/ups_poses.h"

// Random six-legged machines and their poses. For tests/nocsolver/ups_poses_*.

namespace ursula::ups_cases {

constexpr double eps = Eigen::NumTraits<double>::epsilon();

/// Random numbers that are equal everywhere: the standard defines engines exactly, but not distributions.
class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double next() { return static_cast<double>(engine_()) / 2147483648.0 - 1; }
  Vector3d vector() {
    const double x = next(), y = next(), z = next();
    return {x, y, z};
  }
  Matrix3d rotation() {
    const double w = next();
    const Vector3d v = vector();
    return Eigen::Quaterniond(w, v.x(), v.y(), v.z()).normalized().toRotationMatrix();
  }

 private:
  std::mt19937 engine_;
};

using Points = std::array<Vector3d, 6>;

struct Placement {
  Vector3d p;
  Matrix3d Q;
};

struct Machine {
  Points a, b;

  Vector6d lengths(const Placement& at) const {
    Vector6d d;
    for (std::size_t i = 0; i < 6; ++i) d(static_cast<Eigen::Index>(i)) = (at.p + at.Q * b[i] - a[i]).norm();
    return d;
  }

  /// The legs' directions and their moments about p.
  Matrix6d jacobian(const Placement& at) const {
    Matrix6d J;
    for (std::size_t i = 0; i < 6; ++i) {
      const Vector3d Qb = at.Q * b[i], n = (at.p + Qb - a[i]).normalized();
      J.row(static_cast<Eigen::Index>(i)) << Qb.cross(n).transpose(), n.transpose();
    }
    return J;
  }
};

struct Case {
  Machine machine;
  Placement at;

  UpsPoses poses() const { return upsPoses(machine.a, machine.b, machine.lengths(at)); }
};

/// Joints in a cube of 2 m, or in its middle planes.
inline Case thrown(unsigned seed, bool planar = false) {
  Dice dice(seed);
  Case made;
  made.at.Q = dice.rotation();
  made.at.p = dice.vector();
  for (std::size_t i = 0; i < 6; ++i) {
    made.machine.a[i] = dice.vector();
    made.machine.b[i] = dice.vector();
    if (planar) made.machine.a[i].z() = made.machine.b[i].z() = 0;
  }
  return made;
}

inline double distance(const UpsPose& pose, const Placement& at) {
  return std::max((pose.p - at.p).norm(), (pose.Q - at.Q).norm());
}

inline double nearest(const UpsPoses& poses, const Placement& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const UpsPose& pose : poses.list) least = std::min(least, distance(pose, at));
  return least;
}

inline int real(const UpsPoses& poses) {
  int count = 0;
  for (const UpsPose& pose : poses.list) count += pose.multiplicity;
  return count;
}

inline double largestResidual(const UpsPoses& poses) {
  double largest = 0;
  for (const UpsPose& pose : poses.list) largest = std::max(largest, pose.residual);
  return largest;
}

/// Some 16 roundings of lengths of up to 6 m, times the condition number.
inline double expectedError(const Case& made) {
  const Eigen::JacobiSVD<Matrix6d> svd(made.machine.jacobian(made.at));
  return 16 * 6 * eps * svd.singularValues()(0) / svd.singularValues()(5);
}

}  // namespace ursula::ups_cases
