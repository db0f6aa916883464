#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engines/simbody/simbody_loop.h"
#include "validation/external/external_samples.h"
#include "validation/replay/windows.h"

namespace ursula {

/// The replay of external torques on a spline through them.
struct ExternalReplay {
  std::vector<WindowedReplay> windows;  ///< empty where the replay cannot be judged
  ReplayPlan plan;                      ///< how, with the torques replayed
  std::shared_ptr<const Amplification> amplification;
  ReplayScales scales;
  std::string spline;  ///< what the torques may be off by between the samples, in words
  /// What the torques may be off by between the instants: 0 where they were replayed, infinite where they are not
  /// known.
  double between = 0;
  std::string not_replayed;                                 ///< why the replay cannot be judged, else empty
  double bound = std::numeric_limits<double>::quiet_NaN();  ///< where the limit is why, that limit, m
};

/// Replays in windows whose limits hold, beside rounding and integration, the error of interpolation and the digits of
/// the file. The former is that of the NOC's torques splined through the same instants, so that wrong torques never
/// widen their own limit.
ExternalReplay replayExternal(const Scenario& scenario, const ExternalTorques& torques, const Units& units = {});

}  // namespace ursula
