#pragma once

#include <vector>

#include "validation/samples/invariance_samples.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Exact invariances without a reference, `invariance.*`: the world rotated (with gravity), legs relabelled, masses
/// doubled, time reversed. Returns none if the subject is no solver. They use no load.
std::vector<Check> judgeInvariances(const std::vector<InvarianceSamples>& invariances,
                                    const std::vector<PointwiseSample>& samples, const RoundingProfile& profile,
                                    const Units& units = {});

}  // namespace ursula
