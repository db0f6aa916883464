#pragma once

#include <Eigen/Core>
#include <array>

#include "nocsolver/poses/direct_kinematics_algebra.h"

// All common roots of three quadrics, polished and counted. Internal to nocsolver/direct_kinematics*.

namespace ursula::direct {

/// A common root, unit length; of a conjugate pair the first of both.
struct Root {
  Eigen::Vector4cd q = Eigen::Vector4cd::Zero();
  bool real = false;     ///< then q is real, up to sign
  int multiplicity = 1;  ///< how many roots cannot be told from this one in the arithmetic
};

struct Roots {
  std::array<Root, root_count> list;
  int size = 0;      ///< of `list`
  int counted = 0;   ///< roots in the complex numbers, with multiplicities and conjugates: 8 if none was missed
  double pivot = 0;  ///< largest pivot ratio of the charts tried
};

/// Largest |qᵀSₖq| at unit length.
template <class Scalar>
double residual(const ThreeQuadrics& quadrics, const Eigen::Matrix<Scalar, 4, 1>& q) {
  double worst = 0;
  for (const Eigen::Matrix4d& S : quadrics.S) {
    const double value = std::abs((q.transpose() * (S * q)).value());
    worst = value <= worst ? worst : value;  // keeps a NaN
  }
  return worst;
}

/// `rounding`: what the quadrics themselves may be off by, and thus what counts as 0 in them. Tries charts until all
/// eight roots are counted. Does not allocate.
Roots findRoots(const ThreeQuadrics& quadrics, double rounding);

}  // namespace ursula::direct
