#pragma once

#include <cmath>

#include "validation/replay/replay.h"

namespace ursula {

/// NaN if an error is.
inline double largestOf(const Replay& replay, Vector3d ReplayStep::*error) {
  double largest = replay.steps.empty() ? std::nan("") : 0;
  for (const ReplayStep& step : replay.steps)
    if (const double size = (step.*error).norm(); !(size <= largest)) largest = size;
  return largest;
}
inline double maxPositionError(const Replay& replay) { return largestOf(replay, &ReplayStep::position_error); }
inline double maxRotationError(const Replay& replay) { return largestOf(replay, &ReplayStep::rotation_error); }

}  // namespace ursula
