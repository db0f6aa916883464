#include "parts/engines/closing.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace ursula {
namespace {

using Maps = PerLeg<OpenTree::PointMap>;

/// Column m maps effort m to the platform's speeds.
Matrix6d motorMap(const Maps& N, const Manipulator& manipulator) {
  Matrix6d out;
  for (int m = 0; m < motor_count; ++m) {
    const Motor& motor = manipulator.motors()[m];
    out.col(m) = N[motor.leg].row(motor.joint).transpose();
  }
  return out;
}

Maps mapsOf(const OpenTree& tree, const Manipulator& manipulator) {
  Maps N;
  for (int i = 0; i < manipulator.legCount(); ++i) N[i].noalias() = tree.legs[i].J.inverse() * tree.legs[i].P;
  return N;
}

/// Returns [N; 1]ᵀ times the tree's forces.
Vector6d wrenchOf(const OpenTree& tree, const Maps& N, const Manipulator& manipulator) {
  Vector6d wrench = tree.force;
  for (int i = 0; i < manipulator.legCount(); ++i) wrench.noalias() += N[i].transpose() * tree.legs[i].force;
  return wrench;
}

}  // namespace

Vector6d closedEfforts(const OpenTree& tree, const Manipulator& manipulator) {
  const Maps N = mapsOf(tree, manipulator);
  return motorMap(N, manipulator).partialPivLu().solve(wrenchOf(tree, N, manipulator));
}

Vector6d openEfforts(const OpenTree& tree, const Manipulator& manipulator) {
  return forMotors(manipulator, [&](const Motor& motor) { return tree.legs[motor.leg].force(motor.joint); });
}

Vector6d leastEfforts(const OpenTree& tree, const Manipulator& manipulator) {
  const Maps N = mapsOf(tree, manipulator);
  Matrix6d squares = Matrix6d::Identity();
  for (int i = 0; i < manipulator.legCount(); ++i) squares.noalias() += N[i].transpose() * N[i];
  return motorMap(N, manipulator).transpose() * squares.llt().solve(wrenchOf(tree, N, manipulator));
}

/// Each leg satisfies J δ_leg − P δ = −gap, and δ_leg is zero at its motors.
Vector6d displacement(const OpenTree& tree, const PerLeg<Vector3d>& gaps, const Manipulator& manipulator) {
  const Vector6d right = forMotors(manipulator, [&](const Motor& motor) {
    const std::size_t leg = motor.leg;
    return (tree.legs[leg].J.inverse() * gaps[leg])(motor.joint);
  });
  return motorMap(mapsOf(tree, manipulator), manipulator).transpose().partialPivLu().solve(right);
}

Vector6d closedRates(const OpenTree& tree, const OpenTreeMasses& masses, const Manipulator& manipulator,
                     const Vector6d& efforts) {
  Maps N;
  Vector6d wrench = -tree.force;
  Matrix6d mass = masses.platform;
  for (int i = 0; i < manipulator.legCount(); ++i) {
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
    const OpenTree::Leg& leg = tree.legs[i];
    Vector3d force = -leg.force;
    for (int m = 0; m < motor_count; ++m)
      if (const Motor& motor = manipulator.motors()[m]; motor.leg == i) force(motor.joint) += efforts(m);
    const Vector3d opening = leg.J * masses.legs[i].llt().solve(force) - leg.P * platform;
    for (int axis = 0; axis < 3; ++axis) {
      shifted.drift[i](axis) = part * opening(axis);
      change += (closedRates(tree, shifted, manipulator, efforts) - closed).cwiseAbs();
      shifted.drift[i].setZero();
    }
  }
  return change;
}

}  // namespace ursula
