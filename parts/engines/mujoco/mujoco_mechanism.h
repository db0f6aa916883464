#pragma once

#include <memory>

#include "model/mechanism.h"
#include "model/motor_trajectory.h"

namespace ursula {

/// A mechanism with any closed loops in MuJoCo, built from raw parameters alone: a spanning tree without MuJoCo's own
/// constraints, because these are soft. MuJoCo's kinematics and Jacobians close the loops by Newton's method, its
/// mj_rne gives the forces M u̇ + bias on the tree's speeds, and the complement of the closures takes them to the
/// motors. Bodies may be without mass. Not thread-safe.
class MujocoMechanism {
 public:
  /// Throws std::runtime_error if the build lacks MuJoCo, std::domain_error for a spring on a ball, and for loops that
  /// do not close near the reference pose.
  explicit MujocoMechanism(const Mechanism& mechanism);
  ~MujocoMechanism();

  /// Continues the last pose. Throws std::domain_error with a joint's name if the loops cannot follow.
  Eigen::VectorXd inverseDynamics(const MotorMotion& motion);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ursula
