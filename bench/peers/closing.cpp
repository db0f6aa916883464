#include "bench/peers/closing.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace ursula::bench {
namespace {

using Maps = std::array<OpenTree::PointMap, leg_count>;

/// Column m brings effort m onto the platform's speeds.
Matrix6d motorMap(const Maps& N, const Manipulator& manipulator) {
  Matrix6d out;
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = manipulator.motors()[static_cast<std::size_t>(m)];
    out.col(m) = N[static_cast<std::size_t>(motor.leg)].row(motor.joint).transpose();
  }
  return out;
}

}  // namespace

Vector6d closedEfforts(const OpenTree& tree, const Manipulator& manipulator) {
  Maps N;
  Vector6d wrench = tree.force;
  for (std::size_t i = 0; i < static_cast<std::size_t>(manipulator.legCount()); ++i) {
    const OpenTree::Leg& leg = tree.legs[i];
    N[i].noalias() = leg.J.inverse() * leg.P;
    wrench.noalias() += N[i].transpose() * leg.force;
  }
  return motorMap(N, manipulator).partialPivLu().solve(wrench);
}

Vector6d closedRates(const OpenTree& tree, const OpenTreeMasses& masses, const Manipulator& manipulator,
                     const Vector6d& efforts) {
  Maps N;
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
  wrench.noalias() += motorMap(N, manipulator) * efforts;
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

}  // namespace ursula::bench
