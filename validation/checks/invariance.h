#pragma once

#include <vector>

#include "validation/samples/invariance_samples.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Invariances that hold exactly and need no reference: the whole world turned (gravity included), legs relabelled,
/// masses doubled, time reversed. `invariance.*`; none where the subject is no solver. Load is left out of them.
std::vector<Check> judgeInvariances(const std::vector<InvarianceSamples>& invariances,
                                    const std::vector<PointwiseSample>& samples, const RoundingProfile& profile,
                                    const Units& units = {});

}  // namespace ursula
