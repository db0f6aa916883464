#pragma once

#include <vector>

#include "validation/replay/windowed_replay.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Adds the largest torque and acceleration with their errors, condition numbers, and the cost of the replay.
void addFindings(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                 ValidationResult& result, const Units& units = {});

}  // namespace ursula
