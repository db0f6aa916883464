#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/simbody_loop.h"
#include "validation/judge_external.h"
#include "validation/windows.h"

namespace ursula {

/// The replay of somebody else's torques on a spline through them.
struct ExternalReplay {
  std::vector<WindowedReplay> windows;  ///< empty where the replay cannot be judged
  ReplayPlan plan;                      ///< how, with the torques replayed
  std::shared_ptr<const Amplification> amplification;
  std::vector<Check> checks;  ///< those of judgeReplay, inconclusive where there are too few samples
  std::vector<std::pair<std::string, std::string>> findings;
};

/// Replays in windows whose limits hold, beside rounding and integration, the error of interpolation and the digits of
/// the file. The former is that of the NOC's torques splined through the same instants, so that wrong torques never
/// widen their own limit.
ExternalReplay replayExternal(const Scenario& scenario, const ExternalTorques& torques, const Units& units = {});

}  // namespace ursula
