#pragma once

#include <Eigen/Core>
#include <array>

#include "base/scalar.h"

// The poses of six legs of given lengths form a linear section of the motion group's compactification. This header has
// the section and its ring. Internal to nocsolver/ups_poses*.

namespace ursula::ups {

constexpr int solution_count = 40;    ///< degree of the compactification: number of solutions of every finite section
constexpr int coordinate_count = 17;  ///< h, Q row by row, Qᵀp, p, pᵀp: homogeneous, h = 1 for a pose
constexpr int section_count = 11;     ///< dimension of the coordinates that satisfy six legs
constexpr int chart_count = 8;

/// The first index of each kind of coordinate.
constexpr int at_h = 0, at_Q = 1, at_u = 10, at_p = 13, at_r = 16;

using Coordinates = Eigen::Matrix<double, coordinate_count, 1>;
using Section = Eigen::Matrix<double, coordinate_count, section_count>;  // orthonormal columns

/// Six legs, in a unit of length in which their numbers are about 1.
template <class Scalar>
struct LegsOver {
  std::array<Eigen::Matrix<Scalar, 3, 1>, 6> a, b;
  Eigen::Matrix<Scalar, 6, 1> d;
};
using Legs = LegsOver<double>;

struct LegSection {
  Section N;         ///< N z are all coordinates that satisfy the six legs
  double pivot = 0;  ///< ratio of smallest to largest pivot of the six equations
};

LegSection legSection(const Legs& legs);

/// Multiplication by a generic linear form in the section's ring, dimension 40.
struct Multiplication {
  Eigen::MatrixXd M;  ///< 40 × 40; right eigenvectors begin with 1, y₁…y₁₀ of a solution; empty if a pivot is 0
  Section map;        ///< coordinates = map [1; y]
  double pivot = 0;   ///< smallest ratio of pivots; 0 if the section is infinite or meets the chart's infinity
};

/// Computes it in chart `index` of `chart_count`. Allocates.
Multiplication multiplication(const Section& section, int index);

}  // namespace ursula::ups
