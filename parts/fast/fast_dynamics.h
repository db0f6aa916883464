#pragma once

#include <cstdint>
#include <type_traits>

#include "model/manipulator.h"
#include "model/motion.h"
#include "nocsolver/errors.h"
#include "parts/fast/kernels/machine_model.h"
#include "parts/fast/legs_at_once.h"

namespace ursula {

/// Why a pose of a batch has no answer; the first fault, in the order of the legs.
enum class PoseFault : std::uint8_t {
  none,
  out_of_reach,
  end_of_stroke,
  point_on_axis,
  stretched_leg,
  singular_jacobian,
  not_finite  ///< pose, efforts or load are too large, too small or NaN for a finite answer
};

/// Inverse and direct dynamics of any machine, each leg in its own plane (kernels/plane_dynamics.h). It forms no angle
/// and no T, and keeps no state. The batch (batch_dynamics.h) uses the same formulas. Noc, which forms T, is the
/// independent reference; every validation and the tests compare both to rounding.
///
/// In doubles, six legs of one kind with one motor each on the same coordinate are computed together, one per lane.
/// Numbers then differ in the last bits between instruction sets.
///
/// Immutable; threads share it. It does not allocate. Throws like Solver.
template <class S>
class FastDynamics {
 public:
  /// Throws std::invalid_argument unless the processor supports `set`; only doubles use it.
  explicit FastDynamics(const Manipulator& manipulator, InstructionSet set = bestInstructionSet());
  /// Takes the kernels' own input; negative controls change its numbers.
  FastDynamics(const kernel::MachineModel<S>& machine, InstructionSet set);

  /// Efforts of the motors by (37), N·m, or N for sliding coordinates. `load` is an external wrench on the platform,
  /// [moment about P; force], in B.
  Vector6<S> inverseDynamics(const Motion<S>& motion, const Vector6<S>& load = Vector6<S>::Zero()) const;

  /// The platform's twist rate [ω̇; p̈] under efforts, by (36) projected on t_P; ignores accelerations in `motion`.
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
