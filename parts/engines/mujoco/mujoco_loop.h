#pragma once

#include <memory>
#include <string>

#include "model/open_tree.h"
#include "parts/engines/voting_engines.h"

namespace ursula {

/// A further formulation with another engine: the open legs and the free platform are trees in MuJoCo. Its recursive
/// Newton–Euler algorithm and Jacobians give the forces; multipliers at the Bᵢ close the loops. It uses raw parameters
/// and its own geometry, and knows neither the solver nor another formulation.
class MujocoLoop : public Engine {
 public:
  /// Throws std::runtime_error if the build lacks MuJoCo.
  explicit MujocoLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load = nullptr);
  ~MujocoLoop() override;

  Vector6d inverseDynamics(const Motion<double>& motion) override;

  // --- how a user who has the joints' motion and needs only numbers would call MuJoCo ---

  void coordinates(const Motion<double>& motion, const JointMotion& joint_motion, TreeCoordinates& out) const;

  /// Uses mj_rne with accelerations, and mj_jacSite. The platform's speeds are MuJoCo's.
  void openTree(const TreeCoordinates& at, OpenTree& out);
  /// Uses mj_rne without accelerations, mj_crb, mj_jacSite and mj_rnePostConstraint; ignores accelerations in `at`.
  void openTree(const TreeCoordinates& at, OpenTree& out, OpenTreeMasses& masses);
  /// Converts rates of MuJoCo's platform speeds to [ω̇; p̈].
  Vector6d twistRate(const TreeCoordinates& at, const Vector6d& rates_of_speeds) const;

  /// The platform's twist rate [ω̇; p̈] under efforts by mj_forward, with MuJoCo's own `connect` constraints. They are
  /// soft: a share of about 1 − softImpedance() of an unconstrained gap's acceleration remains. They also omit J̇ q̇.
  Vector6d softTwistRate(const TreeCoordinates& at, const Vector6d& efforts);
  /// The impedance nearest to 1 that MuJoCo allows.
  static double softImpedance();

 private:
  friend class MujocoCalls;
  friend class MujocoStepped;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Version of the loaded library, "2.2.2"; "none" without it.
std::string mujocoVersion();

}  // namespace ursula
