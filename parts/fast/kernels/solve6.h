#pragma once

// Solves one system of six equations. Internal. It is unrolled Gaussian elimination with partial pivoting (Golub, Van
// Loan, Matrix Computations, 4th ed., 2013, sect. 3.4). Eigen's blocked factors take twice as long here.

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/scalar.h"

namespace ursula::kernel {

/// Six equations in six unknowns; the last column is the right-hand side.
template <class S>
struct System6 {
  S a[6][7];
};

/// Moves the row with the largest entry in column k to row k.
template <class S>
void pivot(System6<S>& system, int k) {
  using std::abs;
  int largest = k;
  S size = abs(system.a[k][k]);
#pragma GCC unroll 6
  for (int row = k + 1; row < 6; ++row) {
    const S other = abs(system.a[row][k]);
    const bool larger = other > size;
    size = larger ? other : size;
    largest = larger ? row : largest;
  }
  if (largest == k) return;
#pragma GCC unroll 7
  for (int column = k; column < 7; ++column) std::swap(system.a[k][column], system.a[largest][column]);
}

/// Solves the system into its last column; returns the smallest pivot over the largest.
template <class S>
S solve(System6<S>& system) {
  using std::abs;
  using std::max;
  using std::min;
  S(&a)[6][7] = system.a;
  S least, most;
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k) {
    pivot(system, k);
    const S size = abs(a[k][k]);
    least = k == 0 ? size : min(least, size);
    most = k == 0 ? size : max(most, size);
    a[k][k] = S(1) / a[k][k];
#pragma GCC unroll 6
    for (int row = k + 1; row < 6; ++row) {
      const S factor = a[row][k] * a[k][k];
#pragma GCC unroll 7
      for (int column = k + 1; column < 7; ++column) a[row][column] -= factor * a[k][column];
    }
  }
#pragma GCC unroll 6
  for (int k = 5; k >= 0; --k) {
    S sum = a[k][6];
#pragma GCC unroll 6
    for (int column = k + 1; column < 6; ++column) sum -= a[k][column] * a[column][6];
    a[k][6] = sum * a[k][k];
  }
  return least / most;
}

/// Solves M x = right for a symmetric positive definite M, by L D Lᵀ without pivoting (ibid., sect. 4.2).
template <class S>
Vector6<S> solvePositive(const Matrix6<S>& M, const Vector6<S>& right) {
  S l[6][6], per_d[6], x[6];  // l holds L D below the diagonal
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
#pragma GCC unroll 6
    for (int i = j; i < 6; ++i) {
      S sum = M(i, j);
#pragma GCC unroll 6
      for (int k = 0; k < j; ++k) sum -= l[i][k] * (l[j][k] * per_d[k]);
      l[i][j] = sum;
    }
    per_d[j] = S(1) / l[j][j];
    x[j] = right(j);
#pragma GCC unroll 6
    for (int k = 0; k < j; ++k) x[j] -= l[j][k] * x[k];
    x[j] *= per_d[j];
  }
#pragma GCC unroll 6
  for (int j = 4; j >= 0; --j)
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) x[j] -= l[i][j] * per_d[j] * x[i];
  Vector6<S> out;
  for (int j = 0; j < 6; ++j) out(j) = x[j];
  return out;
}

}  // namespace ursula::kernel
