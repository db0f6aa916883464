#pragma once

#include <Eigen/Core>
#include <array>

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

/// 0 ≤ index < chart_count. Does not allocate; M is unusable if pivot is 0 or NaN.
MultiplicationMatrix multiplicationMatrix(const ThreeQuadrics& quadrics, int index);

}  // namespace ursula::direct
