#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/manipulator.h"
#include "model/motion.h"
#include "nocsolver/errors.h"

namespace ursula {

/// Efforts and their derivatives by the platform's pose, twist and twist rate.
///
/// The pose is changed by a displacement of P, m, in B, and by a small turn δ, rad, in B: Q becomes exp([δ]×) Q. The
/// platform's ω, ṗ, ω̇, p̈, in B, stay what they are while the pose changes.
struct EffortsByState {
  using Block = Eigen::Matrix<double, 6, 3>;

  Vector6d efforts;                          ///< N·m, or N
  Eigen::Matrix<double, 6, 18> derivatives;  ///< columns δ, p, ω, ṗ, ω̇, p̈, three each

  Block byOrientation() const { return derivatives.middleCols<3>(0); }
  Block byPosition() const { return derivatives.middleCols<3>(3); }
  Block byAngularVelocity() const { return derivatives.middleCols<3>(6); }
  Block byVelocity() const { return derivatives.middleCols<3>(9); }
  Block byAngularAcceleration() const { return derivatives.middleCols<3>(12); }
  Block byAcceleration() const { return derivatives.middleCols<3>(15); }
};

/// Derivatives of the efforts of inverse dynamics, exact to rounding, of any machine: the kernels of FastDynamics on
/// dual numbers (docs/derivatives.md).
///
/// Immutable: threads share it, and so do copies. Throws as Solver does.
class EffortDerivatives {
 public:
  explicit EffortDerivatives(const Manipulator& manipulator);
  EffortDerivatives(const EffortDerivatives&) = default;  // and no move, which would leave a husk
  EffortDerivatives& operator=(const EffortDerivatives&) = default;

  /// By the state. `load` is an external wrench on the platform, [moment about P; force], in B, as in
  /// FastDynamics::inverseDynamics, and `load_by_turn` its derivative by δ, for a load that turns with the platform.
  /// Does not allocate.
  EffortsByState byState(const Motion<double>& motion, const Vector6d& load = Vector6d::Zero(),
                         const EffortsByState::Block& load_by_turn = EffortsByState::Block::Zero()) const;

  /// One row of six numbers for each column of a table of derivatives.
  using Columns = Eigen::Matrix<double, 6, Eigen::Dynamic>;

  /// Names of the machine's numbers, as the keys of a sweep: "manipulator.gravity.0", "manipulator.platform.inertia.3"
  /// (xy), "manipulator.leg.2.distal.mass". Left out are those that efforts cannot depend on: the length of a cylinder,
  /// of a carriage all but its mass.
  const std::vector<std::string>& parameterNames() const;

  /// By each of them, in SI. An inertia's xy is yx as well; `base_axis` is by its components as they are written, not
  /// of length 1. `load` stays what it is. Allocates what it gives.
  Columns byParameters(const Motion<double>& motion, const Vector6d& load = Vector6d::Zero()) const;

  /// What efforts are linear in, once the geometry is given: mass, first moment and inertia of the platform about P, in
  /// M, and of each link about its first end, in its frame of (40), first moment along the link (its vector, of a link
  /// whose mass centre is off its line); viscous and Coulomb friction; rotors' inertia, of a machine that has some.
  /// "manipulator.platform.first_moment.0", kg·m, "manipulator.leg.2.distal.inertia_at_end.0", kg·m².
  const std::vector<std::string>& regressorNames() const;

  /// The machine's own values of them, π.
  Eigen::VectorXd regressorValues() const;

  /// Y of efforts = Y π, without a load; gravity is in Y. Depends on geometry, gravity and smoothing speeds alone.
  /// Allocates what it gives.
  Columns regressor(const Motion<double>& motion) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace ursula
