#pragma once

#include <memory>
#include <vector>

#include "validation/limits/amplification.h"
#include "validation/limits/conditioning.h"
#include "validation/replay/replay.h"

namespace ursula {

/// The measured integration error in one window, as the change from a replay of the right torques to another one. That
/// has a hundred times the tolerance, or halved steps if the tolerance does not set them. The closer look uses halved
/// steps and changed inputs. Gaps and energy are also the other replay's own. Values are the largest up to each
/// instant.
struct IntegrationError {
  struct At {
    double t = 0;
    double position = 0, rotation = 0;  ///< m, rad
    double gap = 0, gap_rate = 0;       ///< m, m/s
    double energy = 0;                  ///< J
  };
  std::vector<At> steps;  ///< increasing; empty if it was not measured

  bool measured() const { return !steps.empty(); }
  /// The first entry at or after t; infinite beyond the last, which the coarser replay did not reach.
  At at(double t) const;
};

IntegrationError integrationError(const Replay& fine, const Replay& coarse);

/// The gaps at the end of a window due to rounding of the accelerations at which they open.
struct GapOpening {
  double position = 0, velocity = 0;  ///< m, m/s
};

/// A replay and its window of the motion.
struct WindowedReplay {
  GrowthWindow window;
  Replay replay;
  IntegrationError integration = {};
  IntegrationError closer = {};  ///< change with halved steps and changed inputs; empty if not requested
  GapOpening opening = {};
  std::shared_ptr<const Replay> coarse = nullptr;  ///< the coarser replay of the measurement, under the right torques
};

/// `integration_safety` times the measured integration error up to `t`; 0 if nothing was measured.
double measuredError(const WindowedReplay& window, double t, double IntegrationError::At::*part);

/// The factor on a measured integration error, as in Roache's grid convergence index for two grids (Verification and
/// Validation, 1998, ch. 5).
constexpr double integration_safety = 3;

/// The error of one accepted step in each coordinate: the integrator's tolerance and rounding, over 24 coordinates,
/// times their size. m and m/s.
double errorPerStep(double tolerance, double position_scale);

/// The bound of a replay's deviation from the commanded path at `t`, m. It propagates the rounding of accelerations and
/// steps in the worst direction by the variational equations. It adds integration_safety times the measured integration
/// error and closer look; if the former is missing, the tolerance per step replaces it.
double replayLimit(const WindowedReplay& window, double position_scale, double t);

/// The part of replayLimit without the measured integration error, m.
double driftWithoutMeasured(const WindowedReplay& window, double position_scale, double t);

/// The bound of the platform's deviation at `t`, m, from `tolerance` and rounding in each of `steps` steps.
double driftLimit(const GrowthWindow& window, double tolerance, double steps, double position_scale, double t);

/// Above this many metres (times the machine's length over 1 m) a limit on the replay is useless.
constexpr double useful_replay_limit = 1e-6;

/// The largest forces at the spherical joints along the motion.
struct LoopForces {
  double size = 0;  ///< N; they do work if gaps move

  void include(const Conditioning& instant);
};

/// The scales of the replays' limits.
struct ReplayScales {
  double position = 0;  ///< the largest coordinate, m
  double length = 0;    ///< length of the machine, m
  LoopForces forces;
};

}  // namespace ursula
