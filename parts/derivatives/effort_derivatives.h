#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/manipulator.h"
#include "model/motion.h"
#include "nocsolver/errors.h"

namespace ursula {

/// Efforts and their derivatives with respect to the platform's pose, twist and twist rate.
///
/// The pose varies by a displacement of P, m, in B, and by a small rotation δ, rad, in B: Q becomes exp([δ]×) Q. The
/// platform's ω, ṗ, ω̇, p̈, in B, stay fixed while the pose varies.
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

/// Derivatives of the inverse dynamics' efforts, exact to rounding, of any machine. They come from the kernels of
/// FastDynamics on dual numbers (docs/derivatives.md).
///
/// Immutable; threads and copies share it. Throws like Solver.
class EffortDerivatives {
 public:
  explicit EffortDerivatives(const Manipulator& manipulator);
  EffortDerivatives(const EffortDerivatives&) = default;  // no move, which would leave an empty object
  EffortDerivatives& operator=(const EffortDerivatives&) = default;

  /// Derivatives by the state. `load` is an external wrench on the platform, [moment about P; force], in B, as in
  /// FastDynamics::inverseDynamics. `load_by_turn` is its derivative by δ, for a load that turns with the platform.
  /// Does not allocate.
  EffortsByState byState(const Motion<double>& motion, const Vector6d& load = Vector6d::Zero(),
                         const EffortsByState::Block& load_by_turn = EffortsByState::Block::Zero()) const;

  /// One column of six numbers for each derivative.
  using Columns = Eigen::Matrix<double, 6, Eigen::Dynamic>;

  /// Names of the machine's numbers, as keys of a sweep: "manipulator.gravity.0", "manipulator.platform.inertia.3"
  /// (xy), "manipulator.leg.2.distal.mass". Numbers without effect on efforts are omitted: a cylinder's length, and all
  /// of a carriage except its mass.
  const std::vector<std::string>& parameterNames() const;

  /// Derivatives by each number of parameterNames(), in SI. An inertia's xy varies yx as well; `base_axis` varies by
  /// its components as given, without normalisation. `load` stays fixed. Allocates its result.
  Columns byParameters(const Motion<double>& motion, const Vector6d& load = Vector6d::Zero()) const;

  /// Names of the parameters in which efforts are linear for a given geometry. The platform's mass, first moment and
  /// inertia are about P, in M; a link's are about its first end, in its frame of (40). A link's first moment is along
  /// it, or a vector if its mass centre is off its line. Viscous and Coulomb friction and existing rotor inertias
  /// follow. "manipulator.platform.first_moment.0", kg·m, "manipulator.leg.2.distal.inertia_at_end.0", kg·m².
  const std::vector<std::string>& regressorNames() const;

  /// The machine's values of these parameters, π.
  Eigen::VectorXd regressorValues() const;

  /// ∂π/∂p: the derivative of regressorValues() by the numbers of parameterNames(), one column each; zero if Y depends
  /// on the number instead of π. Allocates its result.
  Eigen::MatrixXd regressorByParameters() const;

  /// Y of efforts = Y π, without a load; Y includes gravity. It depends only on geometry, gravity and smoothing speeds.
  /// Allocates its result.
  Columns regressor(const Motion<double>& motion) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace ursula
