#pragma once

#include <Eigen/Core>
#include <array>

#include "nocsolver/poses/direct_kinematics_algebra.h"

// All common roots of three quadrics, polished and counted. Internal to nocsolver/direct_kinematics*.

namespace ursula::direct {

/// A common root, unit length; it stands for both of a conjugate pair.
struct Root {
  Eigen::Vector4cd q = Eigen::Vector4cd::Zero();
  bool real = false;     ///< whether q is real, up to sign
  int multiplicity = 1;  ///< number of roots that rounding merges into this one
};

struct Roots {
  std::array<Root, root_count> list;
  int size = 0;      ///< of `list`
  int counted = 0;   ///< complex roots with multiplicities and conjugates: 8 if none was missed
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

/// `rounding` is the error bound of the quadrics, so smaller values count as 0. Tries charts until all eight roots are
/// counted. Does not allocate.
Roots findRoots(const ThreeQuadrics& quadrics, double rounding);

}  // namespace ursula::direct
