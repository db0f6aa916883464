// Places a mechanism: Newton's method with Simbody's constraint Jacobian from the configuration before, then rates and
// accelerations of all coordinates. Lengths count by the machine's own, so that rows and columns compare.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simbody/simbody_mechanism_internal.h"

namespace ursula {
namespace {

/// Returns where the pivots, which decrease, fall the most; all if none falls by six orders to nearly nothing.
Eigen::Index rankByGap(const Eigen::VectorXd& pivots) {
  constexpr double rounding = 1e-16;
  Eigen::Index rank = pivots.size();
  double steepest = 1e6;
  for (Eigen::Index k = 1; k < pivots.size(); ++k) {
    const double fall = pivots(k - 1) / std::max(pivots(k), rounding * pivots(0));
    if (pivots(k) > 1e-8 * pivots(0) || fall <= steepest) continue;
    steepest = fall;
    rank = k;
  }
  return rank;
}

}  // namespace

LeastSquares::LeastSquares(const Eigen::MatrixXd& A) : columns_(A.cols()) {
  if (A.size() == 0) return;
  qr_.compute(A);
  const Eigen::VectorXd pivots = qr_.matrixQR().diagonal().cwiseAbs();
  if (pivots(0) > 0) rank_ = rankByGap(pivots);
  if (rank_ == columns_ || rank_ == 0) return;
  const double last = pivots(rank_ - 1), next = rank_ < pivots.size() ? pivots(rank_) : 0;
  of_lower_rank_.emplace();
  of_lower_rank_->setThreshold(std::max(std::sqrt(last * next), last * 1e-3) / pivots(0));
  of_lower_rank_->compute(A);
}

Eigen::MatrixXd LeastSquares::solve(const Eigen::MatrixXd& b) const {
  if (rank_ == 0) return Eigen::MatrixXd::Zero(columns_, b.cols());
  if (of_lower_rank_) return of_lower_rank_->solve(b);
  return qr_.solve(b);
}

Eigen::MatrixXd LeastSquares::kernel() const {
  if (!of_lower_rank_) return Eigen::MatrixXd::Identity(columns_, columns_ - rank_);
  const Eigen::MatrixXd all = of_lower_rank_->colsPermutation() * Eigen::MatrixXd(of_lower_rank_->matrixZ().adjoint());
  return all.rightCols(columns_ - of_lower_rank_->rank());
}

Eigen::VectorXi LeastSquares::independentColumns() const {
  if (rank_ == 0) return Eigen::VectorXi();
  return qr_.colsPermutation().indices().head(rank_);
}

// calcG takes a sweep of the tree for each coordinate. Here one sweep serves all coordinates that move no row together,
// and every number has the bits of calcG's.
Eigen::MatrixXd SimbodyMechanism::Impl::closureRows() const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(row_scale.size(), state.getNU());
  Eigen::Index next = moves.rows();
  SimTK::Vector bias, speeds(state.getNU()), errors;
  matter.calcBiasForMultiplyByG(state, bias);
  for (const std::vector<int>& sweep : sweeps) {
    speeds.setToZero();
    for (const int j : sweep) speeds[j] = 1;
    matter.multiplyByG(state, speeds, bias, errors);
    for (const int j : sweep) out.col(j).head(next) = moves.col(j).select(mapped(errors).array(), 0);
  }
  for (const IdleSpin& spin : spins) {
    const Vector3d line = rotation(spin.body) * spin.line;
    const Eigen::MatrixXd J = frameJacobian(spin.body, displacement(spin.body) * bodies[spin.body].origin);
    out.row(next++) = line.transpose() * J.topRows<3>();
  }
  return row_scale.cwiseInverse().asDiagonal() * out * column_scale.asDiagonal();
}

Eigen::MatrixXd SimbodyMechanism::Impl::allRows() const {
  const Eigen::MatrixXd closures = closureRows();
  Eigen::MatrixXd out(closures.rows() + motorCount(), closures.cols());
  out.topRows(closures.rows()) = closures;
  for (Eigen::Index k = 0; k < motorCount(); ++k) {
    const Eigen::VectorXd J = row(coordinates[k], false).J;
    out.row(closures.rows() + k) = J.cwiseProduct(column_scale).transpose() / motorScale(k);
  }
  return out;
}

Eigen::VectorXd SimbodyMechanism::Impl::closureErrors() const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(row_scale.size());
  const SimTK::Vector& errors = state.getQErr();  // those of quaternions come last
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(joint_of_row.size()); ++i)
    out(i) = errors[static_cast<int>(i)] / row_scale(i);
  return out;
}

Eigen::VectorXd SimbodyMechanism::Impl::closureBias() const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(row_scale.size());
  SimTK::Vector bias;
  matter.calcBiasForAccelerationConstraints(state, bias);
  for (int i = 0; i < bias.size(); ++i) out(i) = bias[i];
  Eigen::Index next = bias.size();
  for (const IdleSpin& spin : spins)  // the line turns with the body, so that its rate adds nothing
    out(next++) = (rotation(spin.body) * spin.line)
                      .dot(frameBias(spin.body, displacement(spin.body) * bodies[spin.body].origin).head<3>());
  return out.cwiseQuotient(row_scale);
}

void SimbodyMechanism::Impl::step(const Eigen::VectorXd& scaled) {
  SimTK::Vector u(state.getNU()), q;
  for (int i = 0; i < u.size(); ++i) u[i] = scaled(i) * column_scale(i);
  matter.multiplyByN(state, false, u, q);
  state.updQ() += q;
  matter.normalizeQuaternions(state);
}

bool SimbodyMechanism::Impl::newton(const Eigen::VectorXd& target) {
  // With an error of 1e-9 before the last step, its square is below rounding after it.
  constexpr double near = 1e-9, longest = 0.5, contraction = 0.25;
  double before = longest / contraction;
  for (int i = 0; i < 10; ++i) {
    realize(SimTK::Stage::Position);
    Eigen::VectorXd errors(row_scale.size() + motorCount());
    errors << closureErrors(), motorValues() - target;
    for (Eigen::Index k = 0; k < motorCount(); ++k) errors(row_scale.size() + k) /= motorScale(k);
    const Eigen::VectorXd by = LeastSquares(allRows()).solve(-errors);
    const double size = by.norm();
    if (!(size <= contraction * before) && !(size <= near)) return false;
    step(by);
    before = size;
    if (size > near) continue;
    realize(SimTK::Stage::Position);
    return closureErrors().norm() <= near;
  }
  return false;
}

std::string SimbodyMechanism::Impl::worstJoint() const {
  realize(SimTK::Stage::Position);
  Eigen::Index worst = 0;
  if (row_scale.size() == 0 || joint_of_row.empty()) return "none";
  closureErrors().head(static_cast<Eigen::Index>(joint_of_row.size())).cwiseAbs().maxCoeff(&worst);
  return mechanism.joints()[joint_of_row[worst]].name;
}

void SimbodyMechanism::Impl::moveTo(const Eigen::VectorXd& target, double t) {
  realize(SimTK::Stage::Position);
  const Eigen::VectorXd start = motorValues();
  const SimTK::Vector q_start = state.getQ();
  SimTK::Vector q_before = q_start;
  double share = 0, by = 1;
  while (share < 1) {
    const double next = std::min(1.0, share + by);
    if (newton(next == 1 ? target : Eigen::VectorXd(start + next * (target - start)))) {
      share = next;
      by *= 2;
      q_before = state.getQ();
      continue;
    }
    by /= 2;
    const std::string joint = by < 1e-6 ? worstJoint() : "";
    state.updQ() = by < 1e-6 ? q_start : q_before;
    realize(SimTK::Stage::Position);
    if (by < 1e-6)
      throw std::domain_error(fmt::format(
          "the loop that joint {} closes cannot follow the motors at t = {} s: it ends at {:.3g} of the way there",
          joint, t, share));
  }
}

void SimbodyMechanism::Impl::close() {
  constexpr int most = 100;
  for (int i = 0; i < most; ++i) {
    realize(SimTK::Stage::Position);
    const Eigen::VectorXd errors = closureErrors();
    Eigen::VectorXd by = LeastSquares(closureRows()).solve(-errors);
    const double size = by.norm();
    if (size > 0.5) by *= 0.5 / size;
    step(by);
    if (size > 1e-9) continue;
    realize(SimTK::Stage::Position);
    if (closureErrors().norm() <= 1e-9) return;
    break;
  }
  throw std::domain_error(
      fmt::format("the loop that joint {} closes cannot be closed near the file's pose", worstJoint()));
}

void SimbodyMechanism::Impl::setRatesByMotors(const LeastSquares& factors) {
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(row_scale.size() + motorCount(), motorCount());
  for (Eigen::Index k = 0; k < motorCount(); ++k) right(row_scale.size() + k, k) = 1 / motorScale(k);
  rates = column_scale.asDiagonal() * factors.solve(right);
}

void SimbodyMechanism::Impl::setRates(const MotorMotion& motion) {
  state.setTime(motion.t);
  realize(SimTK::Stage::Position);
  const LeastSquares factors(allRows());
  setRatesByMotors(factors);
  const Eigen::VectorXd u = *rates * motion.qdot;
  for (int i = 0; i < state.getNU(); ++i) state.updU()[i] = u(i);
  realize(SimTK::Stage::Velocity);
  Eigen::VectorXd right(row_scale.size() + motorCount());
  right << -closureBias(), motion.qddot;
  for (Eigen::Index k = 0; k < motorCount(); ++k) {
    double& of_motor = right(row_scale.size() + k);
    of_motor = (of_motor - row(coordinates[k], true).bias) / motorScale(k);
  }
  const Eigen::VectorXd found = column_scale.asDiagonal() * factors.solve(right);
  for (int i = 0; i < u_dot.size(); ++i) u_dot[i] = found(i);
}

}  // namespace ursula
