#pragma once

#include <memory>
#include <string>

#include "engines/further_engines.h"
#include "engines/open_tree.h"

namespace ursula {

/// A further formulation, of another engine: the open legs and the free platform as trees in MuJoCo, whose recursive
/// Newton–Euler algorithm and Jacobians give the forces; the loops are closed by multipliers at the Bᵢ. Made of raw
/// parameters and geometry of its own; it knows neither the solver nor another formulation.
class MujocoLoop : public Engine {
 public:
  /// Throws std::runtime_error in a build without MuJoCo.
  explicit MujocoLoop(const Manipulator& manipulator, std::shared_ptr<const Load> load = nullptr);
  ~MujocoLoop() override;

  Vector6d inverseDynamics(const Motion<double>& motion) override;

  // --- as somebody who has the joints' motion and wants numbers alone would ask MuJoCo ---

  void coordinates(const Motion<double>& motion, const JointMotion& joint_motion, TreeCoordinates& out) const;

  /// By mj_rne with accelerations and mj_jacSite. Speeds of the platform are MuJoCo's.
  void openTree(const TreeCoordinates& at, OpenTree& out);
  /// By mj_rne without, mj_crb, mj_jacSite and mj_rnePostConstraint; accelerations in `at` are not read.
  void openTree(const TreeCoordinates& at, OpenTree& out, OpenTreeMasses& masses);
  /// [ω̇; p̈] of rates of MuJoCo's speeds of the platform.
  Vector6d twistRate(const TreeCoordinates& at, const Vector6d& rates_of_speeds) const;

  /// The platform's twist rate [ω̇; p̈] under efforts by mj_forward, the loops closed by MuJoCo's own `connect`. It is
  /// soft: of the acceleration at which a gap would open without it, about a part of 1 − softImpedance() is left; and
  /// it leaves out J̇ q̇.
  Vector6d softTwistRate(const TreeCoordinates& at, const Vector6d& efforts);
  /// As near to 1 as MuJoCo allows.
  static double softImpedance();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Of the library that is loaded, "2.2.2"; "none" without it.
std::string mujocoVersion();

}  // namespace ursula
