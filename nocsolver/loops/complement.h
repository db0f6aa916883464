#pragma once

#include <Eigen/QR>
#include <vector>

#include "nocsolver/loops/closures.h"

namespace ursula::loops {

/// Solves G_p x = y, for the passive rates, with a rank that was decided before: by least squares, and of least norm.
/// Rows and columns are scaled by the machine's length, so that all are angles.
class PassiveRates {
 public:
  /// `passive` are the indices of the rates, `scale` one number for each.
  PassiveRates(std::vector<int> passive, VectorXd scale);

  const std::vector<int>& passive() const { return passive_; }
  int rank() const { return rank_; }
  /// Decides rank and threshold by the widest gap of the singular values of G_p.
  void decideRank(const MatrixXd& G);
  /// Factorises G_p; returns false if its rank is not the decided one.
  bool factorise(const MatrixXd& G);
  /// Returns the solution for all passive rates, in their own units.
  MatrixXd solve(const MatrixXd& y) const;
  /// Returns a basis of the motions that G_p leaves free, all rates × freedoms; the motors' rows are zero.
  MatrixXd kernel(int rates) const;
  /// Returns whether the determinant of G_p, among the directions of the factorised one, has kept its sign on the way
  /// to this one. Where it has not, a singular pose lies between them, or they are far apart.
  bool keepsSign(const MatrixXd& G) const;
  /// Returns σ_r/σ_1, the reciprocal condition number of G_p, from its factors.
  double reciprocalCondition() const;

 private:
  MatrixXd scaled(const MatrixXd& G) const;

  std::vector<int> passive_;
  VectorXd scale_;
  int rank_ = 0;
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> factors_;
};

/// The rank of a matrix by the widest gap of its singular values, and a threshold within the gap, relative to the
/// largest.
struct GapRank {
  int rank = 0;
  double threshold = 1e-10;
};
GapRank rankByGap(const MatrixXd& A);

}  // namespace ursula::loops
