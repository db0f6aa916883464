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

}  // namespace ursula
