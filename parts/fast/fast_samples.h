#pragma once

#include <functional>
#include <string>
#include <vector>

#include "parts/fast/instruction_set.h"
#include "parts/fast/kernels/machine_model.h"
#include "validation/evidence/injected_fault.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"

namespace ursula {

/// Results of the users' kernels at the samples with one instruction set, for single poses and in a batch.
struct FastAnswers {
  InstructionSet set = InstructionSet::portable;
  std::vector<Vector6d> torques, torques_in_batch;              ///< N·m; batches repeat the instants
  std::vector<Vector6d> accelerations, accelerations_in_batch;  ///< [ω̇; p̈] under FastSamples::efforts
};

/// Results of the same kernels and of the NOC.
struct FastSamples {
  std::vector<std::size_t> samples;              ///< indices of the samples
  std::vector<Vector6d> torques, accelerations;  ///< the NOC's; accelerations under `efforts`
  std::vector<Vector6d> efforts;     ///< the NOC's torques, changed by as much as the largest, off the commanded motion
  std::vector<FastAnswers> answers;  ///< one per instruction set of the processor
  std::string refused;               ///< why a kernel or the NOC had no answer; else empty
};

/// A fault in the kernels for negative controls; empty members change nothing.
struct FastFault : WitnessFault {
  std::function<void(kernel::MachineModel<double>&)> model;  ///< changes the kernels' input
  std::function<void(FastAnswers&)> answers;                 ///< changes the kernels' results
  explicit operator bool() const { return model || answers; }
};

/// Asks at up to 500 samples. The kernels run in SI, as for users; `scenario` is in the units `natural`.
FastSamples runFast(const Scenario& scenario, const Units& natural, const std::vector<PointwiseSample>& samples,
                    const FastFault& fault = {});

}  // namespace ursula
