#pragma once

#include <memory>
#include <vector>

#include "engines/further_engines.h"

namespace ursula {

namespace maximal {
struct Joint;
struct PlacedLeg;
}  // namespace maximal

/// The third formulation: two bodies per leg and the platform, in maximal coordinates. It solves Newton–Euler equations
/// with twelve Lagrange multipliers per leg for the joints' constraints (Shabana, Computational Dynamics, 3rd ed.,
/// sect. 3.4 and 6.3). It uses raw parameters and vector geometry only, neither the solver nor Simbody.
class MaximalLoop : public Engine {
 public:
  explicit MaximalLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load = nullptr);
  ~MaximalLoop() override;

  Vector6d inverseDynamics(const Motion<double>& motion) override;

  /// Pose, twist and twist rate of the bodies in the last motion.
  BodyMotions<double> bodies() const;

 private:
  friend class MaximalCalls;
  using MatrixX = Eigen::MatrixXd;
  using VectorX = Eigen::VectorXd;

  int constraints() const;
  int coordinates() const;
  void place(const Motion<double>& motion);
  void solveMotion(const Motion<double>& motion, bool with_gamma = true);
  Vector6d balance(const Motion<double>& motion) const;
  VectorX unbalanced(const Motion<double>& motion) const;
  Vector3d frictionOf(int leg) const;
  void subtractFriction(int leg, VectorX& w) const;
  double accelerationOf(const Motor& motor) const;
  void addEffort(const Motor& motor, Eigen::Ref<VectorX> wrenches) const;

  Manipulator manipulator_;
  std::shared_ptr<const Load> load_;
  std::vector<BodyMotion<double>> bodies_;  ///< proximal links, distal links, platform
  std::vector<maximal::PlacedLeg> legs_;
  MatrixX G_;      ///< 72 × 78 for six legs
  VectorX gamma_;  ///< G ṫ = γ
};

}  // namespace ursula
