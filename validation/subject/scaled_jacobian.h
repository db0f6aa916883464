#pragma once

#include "base/dense.h"
#include "base/scalar.h"

namespace ursula {

/// B of (23) with moments divided by the machine's length, m.
inline Matrix6d scaledB(Matrix6d B, double length) {
  B.leftCols<3>() /= length;
  return B;
}

/// The condition number in the 2-norm.
inline double conditionNumber(const Matrix6d& matrix) {
  const Vector6d singular = singularValues(matrix);
  return singular(0) / singular(5);
}

}  // namespace ursula
