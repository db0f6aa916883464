#include <algorithm>
#include <cmath>

#include "model/instants.h"
#include "validation/mechanism/mechanism_evidence.h"

namespace ursula {
namespace {

constexpr int grid_size = 257;

/// How far straight lines through every `step`-th column miss all columns, beginning at `first`; before the first and
/// after the last such column they are level. Frobenius norm.
double missOfLines(const Eigen::MatrixXd& efforts, Eigen::Index first, Eigen::Index step) {
  const Eigen::Index last = first + (efforts.cols() - 1 - first) / step * step;
  double sum = 0;
  for (Eigen::Index i = 0; i < efforts.cols(); ++i) {
    const Eigen::Index at = std::clamp(i, first, last);
    const Eigen::Index before = first + (at - first) / step * step;
    const double share = static_cast<double>(at - before) / static_cast<double>(step);
    const Eigen::Index after = std::min(before + step, last);
    sum += (efforts.col(i) - (1 - share) * efforts.col(before) - share * efforts.col(after)).squaredNorm();
  }
  return std::sqrt(sum);
}

/// Whether rows that are `gap` of the motion apart tell more of the efforts than their mean, wherever they begin.
bool isResolved(const Eigen::MatrixXd& efforts, double gap, double spread) {
  const auto step = static_cast<Eigen::Index>(std::ceil(gap * (grid_size - 1)));
  if (step <= 1) return true;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const Eigen::Index first = std::min<Eigen::Index>(quarter * step / 4, grid_size - 1);
    if (!(missOfLines(efforts, first, step) < spread)) return false;
  }
  return true;
}

}  // namespace

Cover coverOf(const std::vector<double>& rows, const LoopMotion& motion, const MotorEfforts& efforts_in) {
  constexpr double constant = 1e-9;  // of the largest effort: a motion at rest is known by one row
  const double duration = motion.trajectory().duration();
  Cover out;
  if (rows.empty()) return out;
  out.begin = rows.front();
  out.end = rows.back();
  double between = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) between = std::max(between, rows[i] - rows[i - 1]);
  const double beyond = std::max(out.begin, duration - out.end);
  out.widest_gap = std::max(between, beyond);
  Eigen::MatrixXd efforts(efforts_in.size(), grid_size);
  LoopWork work;
  Eigen::Index next = 0;
  for (const double t : equallySpaced(duration, grid_size))
    efforts.col(next++) = motion.inverseDynamics(t, work).cwiseProduct(efforts_in);
  out.largest = efforts.cwiseAbs().maxCoeff();
  const Eigen::VectorXd mean = efforts.rowwise().mean();
  const double spread = (efforts.colwise() - mean).norm();
  if (spread <= constant * out.largest * std::sqrt(static_cast<double>(efforts.size()))) return out;
  const double slack = 1e-9 * duration;
  out.is_cut = beyond > between + slack;
  out.is_resolved = isResolved(efforts, out.widest_gap / duration, spread);
  return out;
}

}  // namespace ursula
