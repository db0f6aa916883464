#pragma once

#include <vector>

#include "validation/replay/ladder.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `integration.ladder` and `integration.second`.
std::vector<Check> judgeLadder(const Ladder& ladder, const WindowedReplay& finest, double position_scale,
                               const Units& units = {});

}  // namespace ursula
