#pragma once

#include <vector>

#include "validation/amplification.h"
#include "validation/conditioning.h"
#include "validation/pointwise.h"
#include "validation/replay.h"
#include "validation/result.h"

namespace ursula {

/// A replay and the window of the motion that it was made in.
struct WindowedReplay {
  GrowthWindow window;
  Replay replay;
};

/// Errors that one accepted step may put into each coordinate: the integrator's tolerance and rounding, over 24
/// coordinates, times the coordinates' size. m and m/s.
double errorPerStep(double tolerance, double position_scale);

/// How far `tolerance` and rounding in each of `steps` steps may move the platform from the commanded path by `t`: the
/// limit of replay.position, m.
double driftLimit(const GrowthWindow& window, double tolerance, double steps, double position_scale, double t);

/// Above this many metres (times the machine's length over 1 m) a limit on the replay says nothing worth knowing.
constexpr double useful_replay_limit = 1e-6;

/// Of the forces at the spherical joints, the largest along the motion.
struct LoopForces {
  double size = 0;      ///< they do work where gaps move, N
  double rounding = 0;  ///< Conditioning::gapRounding, m/s²

  void include(const Conditioning& instant);
};

/// `replay.position`, `replay.orientation`, `closure.position`, `closure.velocity`, `energy.balance`, over all windows.
std::vector<Check> judgeReplay(const std::vector<WindowedReplay>& windows, double position_scale, double length,
                               const LoopForces& forces);

}  // namespace ursula
