#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/deadline.h"
#include "engines/simbody/simbody_loop.h"
#include "validation/evidence/external_samples.h"
#include "validation/replay/windows.h"

namespace ursula {

/// The replay of external torques on a spline through them.
struct ExternalReplay {
  std::vector<WindowedReplay> windows;  ///< empty if the replay cannot be judged
  ReplayPlan plan;                      ///< the plan, with the replayed torques
  std::shared_ptr<const Amplification> amplification;
  ReplayScales scales;
  std::string spline;  ///< error of the torques between the samples, in words
  /// Error of the torques between the instants: 0 if they were replayed, infinite if unknown.
  double between = 0;
  std::string not_replayed;                                 ///< why the replay cannot be judged, else empty
  double bound = std::numeric_limits<double>::quiet_NaN();  ///< the limit, m, if it prevents the replay
};

/// Replays in windows. Their limits include rounding, integration, the interpolation error and the digits of the file.
/// The interpolation error is that of the NOC's torques splined through the same instants. So wrong torques never widen
/// their own limit.
ExternalReplay replayExternal(const Scenario& scenario, const ExternalTorques& torques, const Units& units = {},
                              const Deadline& deadline = {});

}  // namespace ursula
