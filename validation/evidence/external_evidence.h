#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/deadline.h"
#include "base/scalar.h"
#include "model/scenario.h"
#include "simbody/simbody_loop.h"
#include "validation/replay/windows.h"
#include "validation/samples/pointwise.h"
#include "validation/subject/frame_change.h"
#include "validation/subject/torque_file.h"

namespace ursula {

/// External torques at their own instants.
struct ExternalTorques {
  TorqueFile file;            ///< every instant lies within the motion
  std::vector<Vector6d> noc;  ///< of the NOC, N·m
  /// Against Simbody. Their `torques_given` is the uncertainty of the printed numbers: the torque's, and the instant's
  /// times τ̇.
  std::vector<PointwiseSample> samples;
  MotionSizes sizes;  ///< of the whole motion

  /// The largest entry of `torques_given`, N·m.
  double largestPrecision() const;
  /// The contribution of the printed digits to limits, in words.
  std::string precisionInWords(const Units& units) const;
};

/// Compares at the file's own instants, so that nothing is interpolated.
ExternalTorques runExternal(const Scenario& scenario, const TorqueFile& file, const Deadline& deadline = {});

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
  std::size_t enough_rows = 0;  ///< equally spaced ones of as many digits that would do; 0 if none do or none lack
};

/// Replays in windows. Their limits include rounding, integration, the interpolation error and the digits of the file.
/// The interpolation error is that of the NOC's torques splined through the same instants. So wrong torques never widen
/// their own limit.
ExternalReplay replayExternal(const Scenario& scenario, const ExternalTorques& torques, const Units& units = {},
                              const Deadline& deadline = {});

}  // namespace ursula
