#pragma once

#include <memory>

#include "model/mechanism.h"
#include "model/motor_trajectory.h"

namespace ursula {

/// A mechanism with any closed loops in maximal coordinates: six speeds of each moving body, and all joints as
/// constraints, in the tree or not. Newton's and Euler's equations with multipliers, Gᵀλ + Sᵀτ = M a + h − loads, give
/// the efforts; redundant constraints make λ ambiguous, never τ. Bodies may be without mass. From raw parameters alone.
/// Not thread-safe.
class MaximalMechanism {
 public:
  /// Throws std::domain_error for a spring on a ball, and for loops that do not close near the reference pose.
  explicit MaximalMechanism(const Mechanism& mechanism);
  ~MaximalMechanism();

  /// Continues the last pose. Throws std::domain_error with a joint's name if the loops cannot follow.
  Eigen::VectorXd inverseDynamics(const MotorMotion& motion);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ursula
