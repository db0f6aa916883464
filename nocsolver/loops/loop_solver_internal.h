#pragma once

// Internals of LoopSolver; only loop_*.cpp include it.

#include "nocsolver/loops/loop_solver.h"

namespace ursula {

using loops::MatrixXd;
using loops::VectorXd;

inline constexpr const char* singular_pose =
    "the pose is singular: passive joints can move while the motors stand still";

/// A spin without effect on any effort: its row is û·J_ω.
struct RestingSpin {
  int element = -1;
  Vector3d axis = Vector3d::Zero();  ///< at the reference pose
};

/// What a body of the tree weighs, merged over bodies that move as one.
struct Lump {
  double mass = 0;
  Vector3d center = Vector3d::Zero();  ///< at the reference pose
  Matrix3d inertia = Matrix3d::Zero();
  std::vector<std::size_t> bodies;

  bool isEmpty() const { return mass == 0 && inertia.isZero(0); }
};

struct LoopSolver::Impl {
  explicit Impl(const Mechanism& given);

  Mechanism mechanism;
  loops::LoopTree tree;
  loops::Closures closures;
  VectorXd scale;                            ///< of each rate: 1, or the machine's length if it slides
  std::vector<int> passive;                  ///< rates that no motor drives
  std::vector<loops::CoordinateLoad> loads;  ///< of each rate
  std::vector<Lump> lumps;                   ///< of each element
  loops::LoopPose reference;                 ///< the assembled one
  double gap = 0;
  loops::PassiveRates rates;  ///< with the rank decided at the assembled pose
  std::vector<RestingSpin> spins;

  int motors() const { return static_cast<int>(tree.rate_of_motor.size()); }
  loops::LoopPose zeroPose() const;
  void assemble();
  /// Returns the pose of bodies that are displaced like these from the reference pose.
  loops::LoopPose poseOf(const std::vector<Eigen::Isometry3d>& start) const;
  std::optional<SingularLoop> singularLoop(const loops::LoopPose& pose) const;
  /// Closes the loops by damped steps over all coordinates; returns what remains, an angle.
  double approach(loops::LoopPose& pose) const;
  void approachFromNearby(loops::LoopPose& pose) const;
  /// Finds idle spins among the kernel's motions, and what else is free.
  void findFreedoms(const loops::LoopPose& pose, LoopFreedoms& out, std::vector<RestingSpin>& spins) const;
  /// Closes the loops by passive rates alone. Returns the length of all steps, or infinity if they do not converge.
  double close(loops::LoopPose& pose, loops::Frames& frames, loops::PassiveRates& solver, int most) const;
  double errorOf(const loops::Frames& frames, std::size_t* joint) const;
  enum class Step { made, too_long, singular };
  /// Moves the motors. A watched step is not made across a singular pose.
  Step step(const VectorXd& from, const VectorXd& to, bool watched, loops::LoopPose& pose) const;
  [[noreturn]] void refuse(const loops::LoopPose& pose, const std::string& what, const std::string& more = "") const;
  /// σ_r/σ_1 of the closures' Jacobian at a pose: of the passive rates, and with the motors'.
  struct Conditions {
    double passive = 1, all = 1;
  };
  Conditions conditionsAt(const loops::LoopPose& pose) const;
  /// Sets N and the bias of the rates, with idle spins at rest.
  void complement(const loops::Frames& frames, const loops::MatrixXd& G, const loops::PassiveRates& solver,
                  MatrixXd& N) const;
  VectorXd bias(const loops::Frames& frames, const loops::PassiveRates& solver) const;
  void stopSpins(const loops::Frames& frames, const loops::PassiveRates& solver, bool accelerations, MatrixXd& u) const;
  void fill(const MotorMotion& motion, const loops::LoopPose& near, loops::Frames& frames, LoopWork& work) const;
  /// Generalised forces of springs, friction and rotors along the tree's coordinates and the cut joints'.
  VectorXd loadForces(const loops::Frames& frames, const LoopWork& work) const;
  void addCutLoads(const loops::Frames& frames, VectorXd& force, MatrixXd* rotors) const;
};

}  // namespace ursula
