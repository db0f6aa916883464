// Quadrics with known common roots: three pairs of planes meet in eight points.

#include "parts/poses/direct_kinematics_parts.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

#include "tests/support/motions.h"

namespace ursula::direct {
namespace {

constexpr double eps = Eigen::NumTraits<double>::epsilon();
constexpr double rounding = 64 * eps;

Eigen::Vector4d randomPoint(SeededDraws& dice) {
  return Eigen::Vector4d(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1))
      .normalized();
}

/// The same roots, with quadrics orthonormal as findRoots expects them.
ThreeQuadrics orthonormal(const std::array<Eigen::Matrix4d, 3>& S) {
  Eigen::Matrix<double, 16, 3> columns;
  for (int k = 0; k < 3; ++k) columns.col(k) = S[static_cast<std::size_t>(k)].reshaped();
  const Eigen::Matrix<double, 16, 3> basis =
      Eigen::HouseholderQR<Eigen::Matrix<double, 16, 3>>(columns).householderQ() *
      Eigen::Matrix<double, 16, 3>::Identity();
  ThreeQuadrics out;
  for (int k = 0; k < 3; ++k) out.S[static_cast<std::size_t>(k)] = basis.col(k).reshaped(4, 4);
  return out;
}

double distanceBetween(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  return std::min((a - b).norm(), (a + b).norm());
}

/// Planes n and m as the quadric nᵀq mᵀq = 0.
struct PlanePairs {
  std::array<std::array<Eigen::Vector4d, 2>, 3> n;

  ThreeQuadrics quadrics() const {
    std::array<Eigen::Matrix4d, 3> S;
    for (std::size_t k = 0; k < 3; ++k) S[k] = n[k][0] * n[k][1].transpose() + n[k][1] * n[k][0].transpose();
    return orthonormal(S);
  }

  /// The root where one plane of each pair meets, selected by the bits of `which`.
  Eigen::Vector4d meeting(unsigned which) const {
    Eigen::Matrix<double, 3, 4> planes;
    for (std::size_t k = 0; k < 3; ++k) planes.row(static_cast<int>(k)) = n[k][which >> k & 1U].transpose();
    return planes.fullPivLu().kernel().col(0).normalized();
  }
};

PlanePairs randomPairs(SeededDraws& dice) {
  PlanePairs pairs;
  for (auto& pair : pairs.n)
    for (Eigen::Vector4d& normal : pair) normal = randomPoint(dice);
  return pairs;
}

/// The distance of the nearest real root from q; 2 if there is none.
double nearest(const Roots& roots, const Eigen::Vector4d& q) {
  double distance = 2;
  for (int i = 0; i < roots.size; ++i) {
    const Root& root = roots.list[static_cast<std::size_t>(i)];
    if (root.real) distance = std::min(distance, distanceBetween(root.q.real(), q));
  }
  return distance;
}

TEST(QuadricRoots, AreTheEightPointsWherePlanesMeet) {
  SeededDraws dice(3);
  for (int n = 0; n < 500; ++n) {
    const PlanePairs pairs = randomPairs(dice);
    const ThreeQuadrics quadrics = pairs.quadrics();
    const Roots roots = findRoots(quadrics, rounding);
    EXPECT_EQ(roots.size, 8);
    EXPECT_EQ(roots.counted, 8);
    for (unsigned which = 0; which < 8; ++which) {
      const Eigen::Vector4d q = pairs.meeting(which);
      Eigen::Matrix<double, 3, 4> J;
      for (int k = 0; k < 3; ++k) J.row(k) = 2 * q.transpose() * quadrics.S[static_cast<std::size_t>(k)];
      const double smallest = Eigen::JacobiSVD<Eigen::Matrix<double, 3, 4>>(J).singularValues()(2);
      EXPECT_LE(nearest(roots, q), rounding / smallest + rounding) << "machine " << n << ", point " << which;
    }
  }
}

/// Both planes of a pair pass through one point of the others, so two of the eight roots coincide there.
TEST(QuadricRoots, CountTwoThatFallTogether) {
  SeededDraws dice(4);
  for (int n = 0; n < 200; ++n) {
    PlanePairs pairs = randomPairs(dice);
    const Eigen::Vector4d q = pairs.meeting(0);
    pairs.n[0][1] -= q * q.dot(pairs.n[0][1]);
    const Roots roots = findRoots(pairs.quadrics(), rounding);
    EXPECT_EQ(roots.counted, 8);
    EXPECT_EQ(roots.size, 7);
    int doubles = 0;
    for (int i = 0; i < roots.size; ++i) {
      const Root& root = roots.list[static_cast<std::size_t>(i)];
      if (root.multiplicity == 1) continue;
      ++doubles;
      EXPECT_EQ(root.multiplicity, 2);
      EXPECT_LE(distanceBetween(root.q.real(), q), 1e-4);  // within (rounding/κ)^½, κ the curvature, above 1e-6
    }
    EXPECT_EQ(doubles, 1);
  }
}

TEST(QuadricRoots, AreFoundWhereOneLiesAtInfinityOfTheFirstChart) {
  SeededDraws dice(5);
  for (int n = 0; n < 200; ++n) {
    Eigen::Vector4d far = randomPoint(dice);
    far(0) = 0;
    const Eigen::Vector4d q = (chart(0) * far).normalized();
    std::array<Eigen::Matrix4d, 3> S;
    for (Eigen::Matrix4d& each : S) {
      for (int j = 0; j < 4; ++j) each.col(j) = randomPoint(dice);
      each = (each + each.transpose()).eval();
      each -= q * q.transpose() * q.dot(each * q);
    }
    const ThreeQuadrics quadrics = orthonormal(S);
    const Roots roots = findRoots(quadrics, rounding);
    EXPECT_LE(multiplicationMatrix(quadrics, 0).pivot, 1e-10) << "the first chart would have done";
    EXPECT_GT(roots.pivot, 1e-10);
    EXPECT_EQ(roots.counted, 8);
    EXPECT_LE(nearest(roots, q), 1e-8);
  }
}

}  // namespace
}  // namespace ursula::direct
