#pragma once

#include <memory>
#include <optional>

#include "model/motion.h"
#include "parts/fast/instruction_set.h"
#include "parts/fast/kernels/batch_functions.h"
#include "parts/fast/kernels/machine_model.h"

namespace ursula::kernel {

/// One pose at a time with a leg in each lane of a pack. It serves machines with six legs of one kind and one motor
/// each on the same coordinate. Internal to FastDynamics. Immutable; threads share it; after construction it does not
/// allocate.
class LegsAtOnce {
 public:
  /// Throws std::invalid_argument unless the processor supports `set`.
  LegsAtOnce(const MachineModel<double>& machine, InstructionSet set);

  /// Efforts as kernel::inverseDynamics, which also sets `pivots`. Returns nullopt for other machines and if a leg
  /// refuses the pose.
  std::optional<Vector6d> inverseDynamics(const Motion<double>& motion, const Vector6d& load, double& pivots) const;

  /// The platform's twist rate as kernel::directDynamics.
  std::optional<Vector6d> directDynamics(const Motion<double>& motion, const Vector6d& efforts,
                                         const Vector6d& load) const;

 private:
  std::optional<BatchFunctions> functions_;
  double per_length_;
  std::shared_ptr<const void> legs_;  ///< null for other machines
};

}  // namespace ursula::kernel
