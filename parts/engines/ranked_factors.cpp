#include "parts/engines/ranked_factors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ursula {
namespace {

/// Where the pivots fall the most; below the last there is the rounding of the first.
Eigen::Index rankOf(const Eigen::VectorXd& pivots) {
  const double floor = pivots(0) * std::numeric_limits<double>::epsilon() * static_cast<double>(pivots.size());
  Eigen::Index rank = 0;
  double deepest = 0;
  for (Eigen::Index i = 0; i < pivots.size(); ++i) {
    const double next = i + 1 < pivots.size() ? std::max(pivots(i + 1), floor) : floor;
    const double fall = std::max(pivots(i), floor) / next;
    if (fall > deepest) deepest = fall, rank = i + 1;
  }
  return rank;
}

double thresholdBelow(const Eigen::VectorXd& pivots, Eigen::Index rank) {
  const double last = pivots(rank - 1), next = rank < pivots.size() ? pivots(rank) : 0;
  return std::max(std::sqrt(last * next), last * 1e-3) / pivots(0);
}

}  // namespace

RankedFactors::RankedFactors(const Eigen::MatrixXd& A) : A_(A), qr_(A) {
  const Eigen::VectorXd pivots = qr_.matrixQR().diagonal().cwiseAbs();
  const Eigen::Index rank = pivots.size() > 0 && pivots(0) > 0 ? rankOf(pivots) : 0;
  if (rank == A.cols()) return;
  const double threshold = rank > 0 ? thresholdBelow(pivots, rank) : 1;
  for (auto* each : {&deficient_, &transposed_}) {
    each->emplace();
    (*each)->setThreshold(threshold);
  }
  deficient_->compute(A);
  transposed_->compute(A.transpose());
}

Eigen::MatrixXd RankedFactors::solve(const Eigen::MatrixXd& b) const {
  if (deficient_) return deficient_->solve(b);
  const Eigen::MatrixXd once = qr_.solve(b);
  return once + qr_.solve(b - A_ * once);
}

Eigen::MatrixXd RankedFactors::kernel() const {
  if (!deficient_) return Eigen::MatrixXd(qr_.cols(), 0);
  const Eigen::MatrixXd all = deficient_->colsPermutation() * Eigen::MatrixXd(deficient_->matrixZ().adjoint());
  return all.rightCols(qr_.cols() - deficient_->rank());
}

Eigen::VectorXd RankedFactors::solveTransposed(const Eigen::VectorXd& b) const {
  const Eigen::VectorXd once = solveTransposedOnce(b);
  return once + solveTransposedOnce(b - A_.transpose() * once);
}

Eigen::VectorXd RankedFactors::solveTransposedOnce(const Eigen::VectorXd& b) const {
  if (transposed_) return transposed_->solve(b);
  const Eigen::Index n = qr_.cols();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(qr_.rows());
  out.head(n) = qr_.matrixQR().topLeftCorner(n, n).triangularView<Eigen::Upper>().transpose().solve(
      qr_.colsPermutation().transpose() * b);
  out.applyOnTheLeft(qr_.householderQ());
  return out;
}

}  // namespace ursula
