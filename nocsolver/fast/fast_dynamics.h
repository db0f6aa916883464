#pragma once

#include <type_traits>

#include "model/manipulator.h"
#include "model/motion.h"
#include "nocsolver/errors.h"
#include "nocsolver/fast/kernels/machine_model.h"
#include "nocsolver/fast/legs_at_once.h"

namespace ursula {

/// Inverse and direct dynamics of any machine, each leg in its own plane (kernels/plane_dynamics.h): no angle and no T
/// is formed, and nothing is kept. The same formulas make a batch (batch_dynamics.h). Noc, which
/// forms T, is its witness: every validation and the tests hold them together to rounding.
///
/// In doubles, six legs of one kind with a motor each on the same coordinate are computed at once, one in each lane of
/// a register. Numbers then differ in the last bits between instruction sets.
///
/// Immutable: threads share it. Nothing here allocates. Throws as Solver does.
template <class S>
class FastDynamics {
 public:
  /// `set` is to be supported, or std::invalid_argument is thrown; scalars other than double have no use for it.
  explicit FastDynamics(const Manipulator& manipulator, InstructionSet set = bestInstructionSet());
  /// Of what the kernels are given: with changed numbers, for controls that must fail.
  FastDynamics(const kernel::MachineModel<S>& machine, InstructionSet set);

  /// Efforts of the motors by (37), N·m, or N where they push; `load` is an external wrench on the platform, [moment
  /// about P; force], in B.
  Vector6<S> inverseDynamics(const Motion<S>& motion, const Vector6<S>& load = Vector6<S>::Zero()) const;

  /// The platform's twist rate [ω̇; p̈] under efforts, by (36) projected on t_P; accelerations in `motion` are not read.
  Vector6<S> directDynamics(const Motion<S>& motion, const Vector6<S>& efforts,
                            const Vector6<S>& load = Vector6<S>::Zero()) const;

 private:
  struct LegByLeg {
    LegByLeg(const kernel::MachineModel<S>&, InstructionSet) {}
  };

  kernel::MachineModel<S> machine_;
  std::conditional_t<std::is_same_v<S, double>, kernel::LegsAtOnce, LegByLeg> at_once_;
};

extern template class FastDynamics<double>;

}  // namespace ursula
