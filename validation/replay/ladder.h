#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"
#include "validation/replay/windowed_replay.h"

namespace ursula {

/// One rung: a replay of the first window at one tolerance.
struct Rung {
  Integrator integrator = Integrator::rkf78;
  double tolerance = 0;
  long evaluations = 0, steps = 0;
  double distance = 0;  ///< distance of its end from that of the finest replay, m
  std::string gave_up;
  bool too_long = false;   ///< as in Replay
  bool left_path = false;  ///< the replay ended early, so its end is meaningless
};

/// Accuracy of Simbody's own integrator; with a finer one its fourth-order error control takes too many steps. If its
/// accelerations have larger errors, in natural units, its steps follow those and not the motion. Then it is no
/// evidence.
constexpr double second_accuracy = 1e-9;

/// The same window replayed at several tolerances, and its beginning with Simbody's own integrator.
struct Ladder {
  std::vector<Rung> rungs;  ///< rkf78 from coarse to fine, at different tolerances
  /// rk_merson at two accuracies or more over the beginning of the window, the finest last. Distances are those from
  /// the finest replay at `second_end`.
  std::vector<Rung> second;
  double second_end = 0;         ///< s
  double second_difference = 0;  ///< between the last two, m
  /// The largest error of the accelerations in Simbody's own integrator until `second_end`, m/s².
  double second_contradiction = 0;
  bool passes_knots = false;            ///< it steps over some knots, so it need not converge
  std::vector<double> observed_orders;  ///< order of the error in the steps between neighbouring rkf78 rungs
  bool asymptotic = false;              ///< both orders within 2 of 8
  AskedTorques asked;                   ///< by all its replays
};

/// Throws OutOfTime. `finest` is the judged replay of the window. Its coarser replay serves as a rung if it would be
/// the same under `torques`. `change` alters the settings of all others.
Ladder replayLadder(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
                    const std::function<void(ReplaySettings&)>& change = nullptr, const Deadline& deadline = {});

/// Adds a rung at ten times the judged tolerance.
void extendLadder(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
                  const std::function<void(ReplaySettings&)>& change, const Deadline& deadline, Ladder& ladder);

}  // namespace ursula
