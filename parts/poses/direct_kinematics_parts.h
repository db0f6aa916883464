#pragma once

#include <Eigen/Core>
#include <array>

#include "nocsolver/legs/leg_model.h"

// The algebra of direct kinematics: three quadrics in a quaternion. Internal to nocsolver/direct_kinematics*.

namespace ursula::direct {

constexpr int root_count = 8;  ///< Bézout: three quadrics in projective space
using Matrix8d = Eigen::Matrix<double, root_count, root_count>;

/// qᵀSₖq = 0, k = 0, 1, 2. The Sₖ are symmetric and orthonormal under the Frobenius product.
struct ThreeQuadrics {
  std::array<Eigen::Matrix4d, 3> S;
};

/// A chart is a fixed generic rotation H of the quaternion's four-space: q = H [1, x, y, z] up to a factor. A pose
/// hardly ever lies in one chart's plane at infinity, and never in those of all charts.
constexpr int chart_count = 8;
const Eigen::Matrix4d& chart(int index);

/// Multiplication by x in the ring of polynomials in x, y, z modulo the three quadrics. The basis begins with 1, x, y,
/// z: M v = x v where v holds the basis at a common root.
struct MultiplicationMatrix {
  Matrix8d M;
  double pivot = 0;  ///< smallest pivot ratio of the elimination; 0 if a root lies in the plane at infinity
};

/// Returns it for a chart, 0 ≤ index < chart_count. Does not allocate; M is unusable if pivot is 0 or NaN.
MultiplicationMatrix multiplicationMatrix(const ThreeQuadrics& quadrics, int index);

// All common roots of three quadrics, polished and counted. Internal to nocsolver/direct_kinematics*.

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

/// Returns the largest |qᵀSₖq| at unit length.
template <class Scalar>
double residual(const ThreeQuadrics& quadrics, const Eigen::Matrix<Scalar, 4, 1>& q) {
  double worst = 0;
  for (const Eigen::Matrix4d& S : quadrics.S) {
    const double value = std::abs((q.transpose() * (S * q)).value());
    worst = value <= worst ? worst : value;  // keeps a NaN
  }
  return worst;
}

/// Finds the roots. `rounding` is the error bound of the quadrics, so smaller values count as 0. Tries charts until all
/// eight roots are counted. Does not allocate.
Roots findRoots(const ThreeQuadrics& quadrics, double rounding);

// The six planes Πᵢ in which the motors hold the points Bᵢ. Internal to nocsolver/direct_kinematics*.

/// A pose in Newton's method.
struct PlacedPlatform {
  Vector3d p;
  Eigen::Vector4d q;  ///< unit, [w, x, y, z]
};

/// Returns the rotation matrix of a unit quaternion [w, x, y, z].
Matrix3d rotation(const Eigen::Vector4d& q);

/// The three quadrics that remain of the planes without p, and the quality of the elimination.
struct Elimination {
  ThreeQuadrics quadrics;
  double normals = 0;       ///< pivot ratio of X: 0 if the xᵢ do not span space, so that p is free
  double independence = 0;  ///< pivot ratio of the quadrics: 0 if they are dependent
};

class Planes {
 public:
  /// Places the planes for finite φ, rad.
  Planes(const MachineParameters<double>& model, const Vector6d& phi);

  const Vector3d& x(int i) const { return x_[i]; }  ///< xᵢ, normal to Πᵢ, in B
  const Vector3d& z(int i) const { return z_[i]; }  ///< zᵢ, in Πᵢ across the axis

  /// Returns xᵢᵀ(p + Qbᵢ − aᵢ), m.
  Vector6d mismatch(const PlacedPlatform& pose) const;

  /// Returns a bound of the rounding error in `mismatch` at an exact pose, m.
  double rounding(const PlacedPlatform& pose) const;

  /// Takes one Newton step on the mismatch; returns its size, m. `orientation` becomes the sign of det B.
  double newtonStep(const Vector6d& mismatch, PlacedPlatform& pose, int& orientation) const;

  Elimination eliminateP() const;

  /// Returns the p that fits all planes best for the quaternion q.
  Vector3d p(const Eigen::Vector4d& q) const;

 private:
  Eigen::Matrix<double, leg_count, 3> normals() const;

  const MachineParameters<double>& model_;
  PerLeg<Vector3d> x_, z_;
  double size_ = 0;  // largest ‖aᵢ‖, m
};

}  // namespace ursula::direct
