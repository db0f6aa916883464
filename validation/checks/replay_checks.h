#pragma once

#include <string>
#include <vector>

#include "validation/replay/windowed_replay.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `replay.position`, `replay.orientation`, `closure.position`, `closure.velocity`, `energy.balance`, over all windows.
/// `cause` says why the accelerations' rounding is large, for limits that it makes useless.
std::vector<Check> judgeReplay(const std::vector<WindowedReplay>& windows, double position_scale, double length,
                               const LoopForces& forces, const Units& units = {}, const std::string& cause = "");

}  // namespace ursula
