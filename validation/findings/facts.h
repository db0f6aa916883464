#pragma once

#include <vector>

#include "validation/replay/windowed_replay.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Largest torque and acceleration with their errors, condition numbers, and what the replay took.
void addFindings(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                 ValidationResult& result, const Units& units = {});

}  // namespace ursula
