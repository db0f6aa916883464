#include <Eigen/QR>
#include <cmath>

#include "parts/causes/mechanism_tried.h"

namespace ursula::mechanisms {
namespace {

/// A fit to first order that explains less of the deviation's square is not improved.
constexpr double worth_fitting = 0.05;
/// An effect that is smaller, relative to the efforts, is none.
constexpr double no_effect = 1e-9;

/// Gauss–Newton by central differences.
class NumberFit {
 public:
  NumberFit(const Tried& tried, const EffortResidual& data) : tried_(tried), residual_(data.residual()), data_(data) {
    x_ = VectorXd::Zero(tried.steps.size());
    predicted_ = tried.change(data, x_);
  }

  const VectorXd& predicted() const { return predicted_; }
  VectorXd left() const { return residual_ - predicted_; }
  int rank() const { return rank_; }
  const VectorXd& x() const { return x_; }

  /// Returns false if the numbers have no effect, or not that of the deviation.
  bool run() {
    if (tried_.steps.size() == 0) return predicted_.norm() > no_effect * data_.noc.norm();
    constexpr int most = 6;
    for (int k = 0; k < most; ++k) {
      const double before = left().norm();
      if (!step()) return k > 0;
      const double share = before > 0 ? left().squaredNorm() / residual_.squaredNorm() : 0;
      if (k == 0 && share > 1 - worth_fitting) return false;
      if (left().norm() > 0.5 * before && k > 0) break;
    }
    return true;
  }

  /// Two standard deviations of each number, from the remainder or the file's digits.
  VectorXd uncertainty() const {
    if (x_.size() == 0) return x_;
    const double count = static_cast<double>(residual_.size());
    const double precision = data_.limit.squaredNorm() / 3;
    const double variance = std::max(left().squaredNorm(), precision) / std::max(1.0, count - 1);
    const MatrixXd A = slopes_;
    const MatrixXd inverse = (A.transpose() * A).completeOrthogonalDecomposition().pseudoInverse();
    return 2 * (variance * inverse.diagonal().cwiseAbs()).cwiseSqrt();
  }

 private:
  void setSlopes() {
    slopes_.resize(residual_.size(), x_.size());
    for (Eigen::Index k = 0; k < x_.size(); ++k) {
      VectorXd above = x_, below = x_;
      above(k) += tried_.steps(k);
      below(k) -= tried_.steps(k);
      slopes_.col(k) = (tried_.change(data_, above) - tried_.change(data_, below)) / (2 * tried_.steps(k));
    }
  }

  bool step() {
    setSlopes();
    const MatrixXd scaled = slopes_ * tried_.steps.asDiagonal();
    if (!(scaled.norm() > no_effect * data_.noc.norm())) return false;
    Eigen::ColPivHouseholderQR<MatrixXd> factors(scaled);
    factors.setThreshold(1e-7);  // what differs less is one number
    rank_ = static_cast<int>(factors.rank());
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> least(scaled);
    least.setThreshold(1e-7);
    VectorXd dx = tried_.steps.asDiagonal() * least.compute(scaled).solve(left());
    const double before = left().norm();
    for (int halvings = 0; halvings < 6; ++halvings, dx /= 2) {
      const VectorXd there = tried_.change(data_, x_ + dx);
      if (!((residual_ - there).norm() < before)) continue;
      x_ += dx;
      predicted_ = there;
      break;
    }
    return true;
  }

  const Tried& tried_;
  const VectorXd residual_;
  const EffortResidual& data_;
  VectorXd x_, predicted_;
  MatrixXd slopes_;
  int rank_ = 0;
};

}  // namespace

double EffortResidual::beyond(const VectorXd& left) const {
  double out = 0;
  for (Eigen::Index i = 0; i < left.size(); ++i) {
    const double share = std::abs(left(i)) / limit(i);
    if (!(share <= out)) out = share;  // NaN counts as the largest
  }
  return out;
}

bool EffortResidual::isSmooth(const VectorXd& left) const {
  constexpr double may_be_rounding = 2, alike = 0.8;
  const Eigen::Index count = left.size() - motors;
  if (count <= 0 || left.norm() <= may_be_rounding * rounds.norm()) return false;
  return left.head(count).dot(left.tail(count)) > alike * left.head(count).norm() * left.tail(count).norm();
}

void addFixed(std::vector<Tried>& out, const NamedCause& named, const ChangeOf& change, const std::string& detail) {
  Tried tried{named, [change](const EffortResidual& of, const VectorXd&) { return change(of); }};
  tried.detail = detail;
  out.push_back(std::move(tried));
}

void addFixed(std::vector<Tried>& out, const NamedCause& named, VectorXd change, const std::string& detail) {
  addFixed(
      out, named, [change = std::move(change)](const EffortResidual&) { return change; }, detail);
}

std::vector<Fitted> fitAll(const std::vector<Tried>& tried, const EffortResidual& data) {
  std::vector<Fitted> out;
  const VectorXd residual = data.residual();
  for (const Tried& each : tried) {
    NumberFit fit(each, data);
    if (!fit.run()) continue;
    Fitted fitted{each.named, each.detail};
    fitted.numbers = fit.rank();
    const VectorXd left = fit.left();
    fitted.unexplained = left.norm() / residual.norm();
    fitted.of_found = left.norm() / std::max(data.found.norm(), 1e-300);
    fitted.beyond = data.beyond(left);
    fitted.is_smooth = data.isSmooth(left);
    fitted.predicted = fit.predicted();
    if (!std::isfinite(fitted.unexplained)) continue;
    if (each.finish && !each.finish(fit.x(), fit.uncertainty(), fitted.named)) continue;
    out.push_back(std::move(fitted));
  }
  return out;
}

}  // namespace ursula::mechanisms
