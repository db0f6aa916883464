#pragma once

#include <memory>
#include <vector>

#include "validation/limits/amplification.h"
#include "validation/limits/conditioning.h"
#include "validation/replay/replay.h"

namespace ursula {

/// What the integration may be off by in one window, measured: the right torques replayed at a hundred times the
/// tolerance, against the same at the tolerance itself, with the gaps and the energy of the coarser. Likewise the
/// closer look: halved steps and other frames. Largest up to each instant.
struct IntegrationError {
  struct At {
    double t = 0;
    double position = 0, rotation = 0;  ///< m, rad
    double gap = 0, gap_rate = 0;       ///< m, m/s
    double energy = 0;                  ///< J
  };
  std::vector<At> steps;  ///< increasing; empty where it was not measured

  bool measured() const { return !steps.empty(); }
  /// The first at or after t; beyond the last all are infinite: the coarser replay did not get there.
  At at(double t) const;
};

IntegrationError integrationError(const Replay& fine, const Replay& coarse);

/// What rounding of the accelerations at which gaps open makes of them by the end of a window.
struct GapOpening {
  double position = 0, velocity = 0;  ///< m, m/s
};

/// A replay and the window of the motion that it was made in.
struct WindowedReplay {
  GrowthWindow window;
  Replay replay;
  IntegrationError integration = {};
  IntegrationError closer = {};  ///< what halved steps and turned frames change; empty where nothing asked for it
  GapOpening opening = {};
  std::shared_ptr<const Replay> coarse = nullptr;  ///< that it was measured with, under the right torques
};

/// `integration_safety` times what was measured of the integration up to `t`; 0 where nothing was.
double measuredError(const WindowedReplay& window, double t, double IntegrationError::At::*part);

/// By which a measured integration error is multiplied, as Roache's grid convergence index does for two grids
/// (Verification and Validation, 1998, ch. 5).
constexpr double integration_safety = 3;

/// Errors that one accepted step may put into each coordinate: the integrator's tolerance and rounding, over 24
/// coordinates, times the coordinates' size. m and m/s.
double errorPerStep(double tolerance, double position_scale);

/// How far a replay may have moved from the commanded path by `t`, m: the accelerations' rounding and that of each
/// step, carried by the variational equations and aligned for the worst, and integration_safety times the measured
/// integration error and closer look; where the former was not measured, the tolerance for each step instead.
double replayLimit(const WindowedReplay& window, double position_scale, double t);

/// As replayLimit, but for what was measured of the integration, m.
double driftWithoutMeasured(const WindowedReplay& window, double position_scale, double t);

/// How far `tolerance` and rounding in each of `steps` steps may move the platform from the commanded path by `t`, m.
double driftLimit(const GrowthWindow& window, double tolerance, double steps, double position_scale, double t);

/// Above this many metres (times the machine's length over 1 m) a limit on the replay says nothing worth knowing.
constexpr double useful_replay_limit = 1e-6;

/// Of the forces at the spherical joints, the largest along the motion.
struct LoopForces {
  double size = 0;  ///< they do work where gaps move, N

  void include(const Conditioning& instant);
};

/// What limits of replays scale with.
struct ReplayScales {
  double position = 0;  ///< the largest coordinate, m
  double length = 0;    ///< of the machine, m
  LoopForces forces;
};

}  // namespace ursula
