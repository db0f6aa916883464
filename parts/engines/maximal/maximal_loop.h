#pragma once

#include <array>
#include <memory>
#include <vector>

#include "parts/engines/voting_engines.h"

namespace ursula {

namespace maximal {

constexpr int base_body = -1;

/// A joint between a parent, which may be the base, and a child. Bodies are numbered as in MaximalLoop.
struct Joint {
  enum class Type { revolute, universal, prismatic };

  Type type = Type::revolute;
  int parent = base_body, child = 0;
  Vector3d point = Vector3d::Zero();  ///< its centre; for a slide, a point of the child on the line
  /// Axes that the child turns about or slides along, in the order of the coordinates. On a universal joint the parent
  /// carries the first axis and the child the second.
  std::array<Vector3d, 2> axes = {Vector3d::Zero(), Vector3d::Zero()};
  Eigen::Matrix<double, 3, 2> across =
      Eigen::Matrix<double, 3, 2>::Zero();  ///< perpendicular to the slide's axis, fixed in the parent

  int rows() const { return type == Type::universal ? 4 : 5; }
  int coordinates() const { return type == Type::universal ? 2 : 1; }
};

/// The links at a pose, and their joints.
struct PlacedLeg {
  std::array<Matrix3d, 2> R;
  std::array<Vector3d, 2> c;
  std::array<Joint, 2> joints;  ///< at the base, then between the links
  Vector3d B;                   ///< centre of the ball on the platform
};

/// Places a leg by vectors and circles only. `first` and `second` number the links' bodies. Throws std::domain_error if
/// the leg cannot reach.
PlacedLeg placeLeg(const Leg& leg, int index, int first, int second, const Motion<double>& motion);

}  // namespace maximal

/// The third formulation: two bodies per leg and the platform, in maximal coordinates. It solves Newton–Euler equations
/// with twelve Lagrange multipliers per leg for the joints' constraints (Shabana, Computational Dynamics, 3rd ed.,
/// sect. 3.4 and 6.3). It uses raw parameters and vector geometry only, neither the solver nor Simbody.
class MaximalLoop : public Engine {
 public:
  explicit MaximalLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load = nullptr);
  ~MaximalLoop() override;

  Vector6d inverseDynamics(const Motion<double>& motion) override;

  /// Returns pose, twist and twist rate of the bodies in the last motion.
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
