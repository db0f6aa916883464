#pragma once

#include <memory>
#include <optional>

#include "model/motion.h"
#include "nocsolver/fast/instruction_set.h"
#include "nocsolver/fast/kernels/batch_functions.h"
#include "nocsolver/fast/kernels/machine_model.h"

namespace ursula::kernel {

/// One pose at a time with a leg in each lane of a pack, for machines whose six legs are of one kind and have one motor
/// each, on the same coordinate. Internal to FastDynamics. Immutable: threads share it; nothing is allocated after the
/// construction.
class LegsAtOnce {
 public:
  /// `set` is to be supported, or std::invalid_argument is thrown.
  LegsAtOnce(const MachineModel<double>& machine, InstructionSet set);

  /// Efforts as kernel::inverseDynamics, which sets `pivots`, too. None for other machines and where a leg cannot take
  /// the pose.
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
