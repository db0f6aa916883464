#include <cmath>

#include "base/dense.h"
#include "parts/causes/fits.h"
#include "parts/causes/mechanism_tried.h"

namespace ursula::mechanisms {
namespace {

/// M times accelerations of the motors, one column an instant.
VectorXd inertiaTimes(const EffortResidual& data, const MatrixXd& accelerations) {
  VectorXd out(data.noc.size());
  for (std::size_t i = 0; i < data.inertia.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    out.segment(at * data.motors, data.motors) = data.inertia[i] * accelerations.col(at);
  }
  return out;
}

/// Adds the factor c of a simulator's accelerations: the wanted q̈ needs efforts with q̈/c, that is (1/c − 1) M q̈ more.
void addFactor(const NamedCause& of, const VectorXd& part, std::vector<Tried>& out) {
  NamedCause named = of;
  named.kind = CauseKind::sign;
  addFixed(out, named, VectorXd(-2 * part));
  named.kind = CauseKind::scale;
  named.expected = 1;
  Tried fitted{named, [part](const EffortResidual&, const VectorXd& x) { return VectorXd(x(0) * part); },
               VectorXd::Ones(1)};
  fitted.finish = [](const VectorXd& x, const VectorXd& uncertainty, NamedCause& cause) {
    if (std::abs(1 + x(0)) < 1e-9) return false;  // no accelerations at all
    const double factor = 1 / (1 + x(0));
    cause.found = factor;
    cause.uncertainty = uncertainty(0) * factor * factor;
    if (isUnit(factor)) cause.kind = CauseKind::units;
    return true;
  };
  out.push_back(std::move(fitted));
}

/// What a simulator calls the acceleration of motor i is that of another, perhaps with the other sign.
void addOrderOfAccelerations(const EffortResidual& data, const MatrixXd& wanted, std::vector<Tried>& out) {
  MatrixXd right = wanted;  // of the machine under the efforts found
  for (std::size_t i = 0; i < data.inertia.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    right.col(at) += inverseOf(data.inertia[i]) * data.residual().segment(at * data.motors, data.motors);
  }
  const MotorPairs pairs(wanted, right);
  double least = 0;
  const std::vector<std::size_t> order = pairs.best(least);
  NamedCause named{CauseKind::order, "acceleration"};
  MatrixXd expected = wanted;
  bool is_order = false, is_flipped = false;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double sign = pairs.signAt(i, order[i]);
    expected.row(static_cast<Eigen::Index>(order[i])) = sign * wanted.row(static_cast<Eigen::Index>(i));
    named.legs.push_back(static_cast<int>(order[i]) + 1);
    named.signs.push_back(sign < 0 ? -1 : 1);
    is_order = is_order || order[i] != i;
    is_flipped = is_flipped || sign < 0;
  }
  if (!is_order) return;  // one sign, or all, are factors
  if (!is_flipped) named.signs.clear();
  addFixed(out, named, inertiaTimes(data, expected - wanted));
}

}  // namespace

void addAccelerationCauses(const EffortResidual& data, std::vector<Tried>& out) {
  if (data.inertia.empty()) return;
  MatrixXd wanted(data.motors, static_cast<Eigen::Index>(data.inertia.size()));
  for (std::size_t i = 0; i < data.inertia.size(); ++i)
    wanted.col(static_cast<Eigen::Index>(i)) = data.instants[i].motion.qddot;
  NamedCause named{CauseKind::scale, "acceleration", "all"};
  addFactor(named, inertiaTimes(data, wanted), out);
  addOrderOfAccelerations(data, wanted, out);
  named.body.clear();
  for (Eigen::Index k = 0; k < data.motors && data.motors > 1; ++k) {
    MatrixXd one = MatrixXd::Zero(wanted.rows(), wanted.cols());
    one.row(k) = wanted.row(k);
    named.motor = static_cast<int>(k) + 1;
    addFactor(named, inertiaTimes(data, one), out);
  }
}

}  // namespace ursula::mechanisms
