#pragma once

#include <memory>

#include "model/manipulator.h"
#include "model/motion.h"
#include "nocsolver/batch_dynamics.h"
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

/// Derivatives of the efforts of inverse dynamics, exact to rounding, of any machine.
///
/// Immutable: threads share it. Throws as Solver does.
class EffortDerivatives {
 public:
  /// `set` is to be supported, or std::invalid_argument is thrown.
  explicit EffortDerivatives(const Manipulator& manipulator, InstructionSet set = bestInstructionSet());
  ~EffortDerivatives();
  EffortDerivatives(EffortDerivatives&&) noexcept;
  EffortDerivatives& operator=(EffortDerivatives&&) noexcept;

  /// By the state. `load` is an external wrench on the platform, [moment about P; force], in B, as in
  /// FastDynamics::inverseDynamics, and `load_by_turn` its derivative by δ, for a load that turns with the platform.
  /// Does not allocate.
  EffortsByState byState(const Motion<double>& motion, const Vector6d& load = Vector6d::Zero(),
                         const EffortsByState::Block& load_by_turn = EffortsByState::Block::Zero()) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace ursula
