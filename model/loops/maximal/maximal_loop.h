#pragma once

#include <memory>

#include "model/loops/road.h"

namespace ursula {

/// The third road: the 13 bodies in maximal coordinates, Newton–Euler equations with Lagrange multipliers for the 72
/// joint constraints (Shabana, Computational Dynamics, 3rd ed., sect. 3.4 and 6.3). Made of raw parameters and vector
/// geometry alone; it knows neither the solver nor Simbody.
class MaximalLoop : public Road {
 public:
  explicit MaximalLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load = nullptr);

  Vector6d inverseDynamics(const Motion<double>& motion) override;

  /// Pose, twist and twist rate of the bodies at the motion last asked for.
  const BodyMotions<double>& bodies() const { return bodies_; }

 private:
  using MatrixX = Eigen::MatrixXd;
  using VectorX = Eigen::VectorXd;

  void placeLeg(int index, const Motion<double>& motion);
  void solveMotion(const Motion<double>& motion);
  VectorX unbalanced(const Motion<double>& motion) const;

  Manipulator manipulator_;
  std::shared_ptr<const Load> load_;
  BodyMotions<double> bodies_;
  MatrixX G_;      ///< 72 × 78
  VectorX gamma_;  ///< G ṫ = γ
};

}  // namespace ursula
