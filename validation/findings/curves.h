#pragma once

#include <vector>

#include "validation/replay/ladder.h"
#include "validation/replay/windowed_replay.h"
#include "validation/samples/pointwise.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Adds curves for the report: the replay's error with its derived limit, and the growth of a deviation in each window.
/// Further ones are the distances to singular poses and to the workspace's edge. Adds the replay's events.
void addCurves(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
               ValidationResult& result);

/// Error over derivative evaluations, for the report.
TimeSeries workPrecision(const Ladder& ladder);

}  // namespace ursula
