#include "nocsolver/loops/complement.h"

#include <algorithm>
#include <cmath>

#include "base/dense.h"

namespace ursula::loops {

GapRank rankByGap(const MatrixXd& A) {
  GapRank out;
  if (A.rows() == 0 || A.cols() == 0) return out;
  const VectorXd sigma = singularValues(A);
  const double largest = sigma(0);
  if (!(largest > 0)) return out;
  // Values below rounding are one zero; the full rank competes with what lies below the last value.
  constexpr double rounding = 1e-15, least_gap = 1e4;
  double widest = least_gap;
  out.rank = static_cast<int>(sigma.size());
  out.threshold = std::max(rounding, 1e-3 * sigma(sigma.size() - 1) / largest);
  for (Eigen::Index i = 0; i + 1 < sigma.size(); ++i) {
    const double above = sigma(i) / largest, below = std::max(sigma(i + 1) / largest, rounding);
    if (above <= rounding || below > 1e-5) continue;
    if (above / below > widest) {
      widest = above / below;
      out.rank = static_cast<int>(i) + 1;
      out.threshold = std::sqrt(above * below);
    }
  }
  return out;
}

PassiveRates::PassiveRates(std::vector<int> passive, VectorXd scale)
    : passive_(std::move(passive)), scale_(std::move(scale)) {}

MatrixXd PassiveRates::scaled(const MatrixXd& G) const {
  MatrixXd out(G.rows(), static_cast<Eigen::Index>(passive_.size()));
  for (std::size_t k = 0; k < passive_.size(); ++k)
    out.col(static_cast<Eigen::Index>(k)) = G.col(passive_[k]) * scale_(passive_[k]);
  return out;
}

void PassiveRates::decideRank(const MatrixXd& G) {
  const GapRank found = rankByGap(scaled(G));
  rank_ = found.rank;
  factors_.setThreshold(found.threshold);
}

bool PassiveRates::factorise(const MatrixXd& G) {
  if (passive_.empty() || G.rows() == 0) return true;
  factors_.compute(scaled(G));
  return factors_.rank() == rank_;
}

MatrixXd PassiveRates::solve(const MatrixXd& y) const {
  const auto n = static_cast<Eigen::Index>(passive_.size());
  if (n == 0 || y.rows() == 0) return MatrixXd::Zero(n, y.cols());
  MatrixXd out = factors_.solve(y);
  for (Eigen::Index k = 0; k < n; ++k) out.row(k) *= scale_(passive_[k]);
  return out;
}

MatrixXd PassiveRates::kernel(int rates) const {
  const auto n = static_cast<Eigen::Index>(passive_.size());
  const Eigen::Index free = n - rank_;
  MatrixXd out = MatrixXd::Zero(rates, free);
  if (free == 0) return out;
  MatrixXd own = MatrixXd::Identity(n, n);
  if (rank_ > 0) own = factors_.colsPermutation() * MatrixXd(factors_.matrixZ().adjoint());
  for (Eigen::Index k = 0; k < n; ++k) {
    const int rate = passive_[k];
    out.row(rate) = scale_(rate) * own.row(k).rightCols(free);
  }
  return out;
}

// G_p P Z' = Q [T 0; 0 0]: between the same directions the next G_p has an r × r block like T.
bool PassiveRates::keepsSign(const MatrixXd& G) const {
  if (rank_ == 0 || G.rows() == 0) return true;
  MatrixXd next = factors_.householderQ().adjoint() * MatrixXd(scaled(G) * factors_.colsPermutation());
  if (rank_ < next.cols()) next = (next * factors_.matrixZ().adjoint()).eval();
  const double before = factors_.matrixQTZ().diagonal().head(rank_).prod();
  return before * next.topLeftCorner(rank_, rank_).determinant() > 0;
}

double PassiveRates::reciprocalCondition() const {
  if (rank_ == 0) return 1;
  const auto diagonal = factors_.matrixQTZ().diagonal().cwiseAbs();
  return diagonal(rank_ - 1) / diagonal(0);
}

}  // namespace ursula::loops
