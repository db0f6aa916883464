#pragma once

#include <vector>

#include "validation/replay/stabilised_replay.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `feedback.torque`, N·m: the torque that the stabilising term added. `largest` is that of the right torques.
Check judgeStabilised(const StabilisedReplay& found, double largest, const Units& units = {});

}  // namespace ursula
