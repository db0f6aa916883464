#pragma once

#include <functional>
#include <string>
#include <vector>

#include "nocsolver/fast/instruction_set.h"
#include "nocsolver/fast/kernels/machine_model.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"

namespace ursula {

/// What the kernels that users call answer at the samples, by one instruction set: one pose at a time and in a batch.
struct FastAnswers {
  InstructionSet set = InstructionSet::portable;
  std::vector<Vector6d> torques, torques_in_batch;              ///< N·m; batches go over the instants again and again
  std::vector<Vector6d> accelerations, accelerations_in_batch;  ///< [ω̇; p̈] under FastSamples::efforts
};

/// The same kernels and the NOC.
struct FastSamples {
  std::vector<std::size_t> samples;              ///< at which of them
  std::vector<Vector6d> torques, accelerations;  ///< the NOC's; accelerations under `efforts`
  std::vector<Vector6d> efforts;     ///< the NOC's torques, changed by as much as the largest: off the commanded motion
  std::vector<FastAnswers> answers;  ///< for each instruction set that the processor has
  std::string refused;               ///< why somebody had no answer; empty where all had
};

/// A fault in the kernels, for controls that must fail; what is empty stays right.
struct FastFault {
  std::function<void(kernel::MachineModel<double>&)> model;  ///< in the numbers that the kernels are given
  std::function<void(FastAnswers&)> answers;                 ///< in what they say
  explicit operator bool() const { return model || answers; }
};

/// At 500 of the samples, or all. The kernels are asked in SI, as users ask them; `scenario` is in the units `natural`.
FastSamples runFast(const Scenario& scenario, const Units& natural, const std::vector<PointwiseSample>& samples,
                    const FastFault& fault = {});

}  // namespace ursula
