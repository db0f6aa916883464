#pragma once

#include <string>
#include <utility>
#include <vector>

#include "parts/fast/fast_samples.h"
#include "validation/checks/families.h"

namespace ursula {

/// Compares the kernels that users call, with every instruction set of the processor, with the NOC: `fast.inverse`,
/// `fast.direct`, `fast.inverse_batch`, `fast.direct_batch`. `fast` is at `samples`.
std::vector<Check> judgeFast(const FastSamples& fast, const std::vector<PointwiseSample>& samples, const Units& units,
                             const MotionSizes& sizes = {});

/// Adds the family of these checks, with its experiment, to checkFamilies().
void addFastFamilies(std::vector<CheckFamily>& rows);
/// Adds the instruction set of the kernels to partProvenance().
void addFastProvenance(std::vector<std::pair<std::string, std::string>>& rows);

}  // namespace ursula
