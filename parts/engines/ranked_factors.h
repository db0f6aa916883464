#pragma once

#include <Eigen/QR>
#include <optional>

namespace ursula {

/// Least squares and least norm by a pivoted QR factorisation; the rank is where the pivots fall the most.
class RankedFactors {
 public:
  explicit RankedFactors(const Eigen::MatrixXd& A);
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// Returns a basis of the x with A x = 0, as columns.
  Eigen::MatrixXd kernel() const;
  /// Solves Aᵀ x = b.
  Eigen::VectorXd solveTransposed(const Eigen::VectorXd& b) const;

 private:
  Eigen::VectorXd solveTransposedOnce(const Eigen::VectorXd& b) const;

  Eigen::MatrixXd A_;  ///< each solution is refined once by it
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
  std::optional<Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>> deficient_, transposed_;
};

}  // namespace ursula
