#pragma once

#include <cstddef>
#include <memory>

#include "model/manipulator.h"
#include "model/motion.h"
#include "nocsolver/fast/instruction_set.h"
#include "nocsolver/fast/kernels/machine_model.h"
#include "nocsolver/fast/pose_fault.h"

namespace ursula {

/// FastDynamics over many poses: the same formulas, as many poses at a time as a register has lanes. A pose without an
/// answer is flagged, its numbers are NaN, and no other is touched by it.
///
/// Numbers do not depend on where in a batch a pose is, or on how long the batch is. They differ in the last bits
/// between instruction sets (fused products, tanh) and from FastDynamics.
///
/// Immutable: threads share it, and so do copies. Nothing is allocated after the construction. Throws nothing.
class BatchDynamics {
 public:
  /// `set` is to be supported, or std::invalid_argument is thrown.
  explicit BatchDynamics(const Manipulator& manipulator, InstructionSet set = bestInstructionSet());
  /// Of what the kernels are given: with changed numbers, for controls that must fail.
  BatchDynamics(const kernel::MachineModel<double>& machine, InstructionSet set);
  BatchDynamics(const BatchDynamics&) = default;  // and no move, which would leave a husk
  BatchDynamics& operator=(const BatchDynamics&) = default;

  InstructionSet instructionSet() const;

  /// Efforts as FastDynamics::inverseDynamics; all pointers to `count` entries. `loads` may be null: no load.
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
