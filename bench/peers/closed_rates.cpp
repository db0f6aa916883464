#include "bench/peers/closed_rates.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace ursula {

Vector6d closedRates(const OpenTree& tree, const OpenTreeMasses& masses, const Manipulator& manipulator,
                     const Vector6d& efforts) {
  std::array<OpenTree::PointMap, leg_count> N;
  Vector6d wrench = -tree.force;
  Matrix6d mass = masses.platform;
  for (std::size_t i = 0; i < static_cast<std::size_t>(manipulator.legCount()); ++i) {
    const OpenTree::Leg& leg = tree.legs[i];
    const Matrix3d J_inverse = leg.J.inverse();
    N[i].noalias() = J_inverse * leg.P;
    const OpenTree::PointMap MN = masses.legs[i] * N[i];
    mass.noalias() += N[i].transpose() * MN;
    const Vector3d at_rest = masses.legs[i] * (J_inverse * masses.drift[i]) + leg.force;
    wrench.noalias() -= N[i].transpose() * at_rest;
  }
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = manipulator.motors()[static_cast<std::size_t>(m)];
    wrench += efforts(m) * N[static_cast<std::size_t>(motor.leg)].row(motor.joint).transpose();
  }
  return mass.llt().solve(wrench);
}

Vector6d changeOfRates(const OpenTree& tree, const OpenTreeMasses& masses, const Manipulator& manipulator,
                       const Vector6d& efforts, double part) {
  const Vector6d platform = -masses.platform.llt().solve(tree.force);
  OpenTreeMasses shifted = masses;
  for (Vector3d& drift : shifted.drift) drift.setZero();
  const Vector6d closed = closedRates(tree, shifted, manipulator, efforts);
  Vector6d change = Vector6d::Zero();
  for (int i = 0; i < manipulator.legCount(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const OpenTree::Leg& leg = tree.legs[at];
    Vector3d force = -leg.force;
    for (int m = 0; m < motor_count; ++m)
      if (const Motor& motor = manipulator.motors()[static_cast<std::size_t>(m)]; motor.leg == i)
        force(motor.joint) += efforts(m);
    const Vector3d opening = leg.J * masses.legs[at].llt().solve(force) - leg.P * platform;
    for (int axis = 0; axis < 3; ++axis) {
      shifted.drift[at](axis) = part * opening(axis);
      change += (closedRates(tree, shifted, manipulator, efforts) - closed).cwiseAbs();
      shifted.drift[at].setZero();
    }
  }
  return change;
}

}  // namespace ursula
