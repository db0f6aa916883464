#pragma once

#include <cstddef>
#include <memory>

#include "model/manipulator.h"
#include "model/motion.h"
#include "parts/fast/fast_dynamics.h"
#include "parts/fast/instruction_set.h"
#include "parts/fast/kernels/machine_model.h"

namespace ursula {

/// FastDynamics over many poses: the same formulas, with one pose in each lane of a register. A pose without an answer
/// is flagged and its numbers are NaN; it affects no other pose.
///
/// Numbers do not depend on a pose's place in the batch or on the batch's length. They differ in the last bits
/// between instruction sets (fused products, tanh) and from FastDynamics.
///
/// Immutable; threads and copies share it. After construction it neither allocates nor throws.
class BatchDynamics {
 public:
  /// Throws std::invalid_argument unless the processor supports `set`.
  explicit BatchDynamics(const Manipulator& manipulator, InstructionSet set = bestInstructionSet());
  /// Takes the kernels' own input; negative controls change its numbers.
  BatchDynamics(const kernel::MachineModel<double>& machine, InstructionSet set);
  BatchDynamics(const BatchDynamics&) = default;  // no move, which would leave an empty object
  BatchDynamics& operator=(const BatchDynamics&) = default;

  InstructionSet instructionSet() const;

  /// Efforts as FastDynamics::inverseDynamics; all pointers have `count` entries. Without a load `loads` is null.
  void inverseDynamics(const Motion<double>* motions, std::size_t count, Vector6d* efforts, PoseFault* faults,
                       const Vector6d* loads = nullptr) const;

  /// Twist rates [ω̇; p̈] as FastDynamics::directDynamics.
  void directDynamics(const Motion<double>* motions, const Vector6d* efforts, std::size_t count, Vector6d* twist_rates,
                      PoseFault* faults, const Vector6d* loads = nullptr) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace ursula
