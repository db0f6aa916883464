#pragma once

#include "validation/limits/rounding_profile.h"
#include "validation/samples/fast_samples.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Compares the kernels that users call, with every instruction set of the processor, with the NOC: `fast.inverse`,
/// `fast.direct`, `fast.inverse_batch`, `fast.direct_batch`. `fast` is at `samples`.
std::vector<Check> judgeFast(const FastSamples& fast, const std::vector<PointwiseSample>& samples, const Units& units);

}  // namespace ursula
