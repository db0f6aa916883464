#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/replay/windowed_replay.h"

namespace ursula {

/// One rung: a replay of the first window at one tolerance.
struct Rung {
  Integrator integrator = Integrator::rkf78;
  double tolerance = 0;
  long evaluations = 0, steps = 0;
  double distance = 0;  ///< of its end from the end of the finest replay, m
  std::string gave_up;
  bool too_long = false;   ///< as Replay has it
  bool left_path = false;  ///< the replay ended early, so that its end says nothing
};

/// Of Simbody's own integrator: error control of fourth order takes too many steps beyond. Where its accelerations are
/// off by more, in natural units, its steps follow that and not the motion, and it is no evidence.
constexpr double second_accuracy = 1e-9;

/// The same window replayed at several tolerances, and its beginning with Simbody's own integrator.
struct Ladder {
  std::vector<Rung> rungs;  ///< rkf78 from coarse to fine
  /// rk_merson at two accuracies and more, the finest last, over the beginning of the window: distances at
  /// `second_end` from the finest replay.
  std::vector<Rung> second;
  double second_end = 0;         ///< s
  double second_difference = 0;  ///< between the last two, m
  /// The largest error of the accelerations that Simbody's own integrator uses, until `second_end`, m/s².
  double second_contradiction = 0;
  bool passes_knots = false;            ///< over some it steps, so that it need not converge
  std::vector<double> observed_orders;  ///< between neighbouring rkf78 rungs, of the error against the steps
  bool asymptotic = false;              ///< both orders within 2 of 8
  double extrapolated = 0;              ///< estimated integration error of the finest replay at its end, m
  double uncertainty = 0;               ///< of that estimate, m
  AskedTorques asked;                   ///< by all of its replays
};

/// `finest` is the judged replay of the window; where its coarser replay would be the same under `torques` it is a rung
/// already. `change`, of the settings of all others.
Ladder climb(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
             const std::function<void(ReplaySettings&)>& change = nullptr);

/// One rung more, at ten times the judged tolerance.
void climbOn(const Scenario& scenario, const SimbodyLoop::TorqueHistory& torques, const WindowedReplay& finest,
             const std::function<void(ReplaySettings&)>& change, Ladder& ladder);

}  // namespace ursula
