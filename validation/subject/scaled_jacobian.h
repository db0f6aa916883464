#pragma once

#include <Eigen/SVD>

#include "nocsolver/solver.h"

namespace ursula {

/// B of (23) with moments over the machine's length. Needs jacobians in `work`.
inline Matrix6d scaledB(const Solver<double>& solver, const Workspace<double>& work) {
  Matrix6d B = solver.B(work);
  B.leftCols<3>() /= solver.length();
  return B;
}

/// By the 2-norm.
inline double conditionNumber(const Matrix6d& matrix) {
  const Vector6d singular = Eigen::JacobiSVD<Matrix6d>(matrix).singularValues();
  return singular(0) / singular(5);
}

}  // namespace ursula
