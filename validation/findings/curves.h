#pragma once

#include <vector>

#include "validation/replay/ladder.h"
#include "validation/replay/windowed_replay.h"
#include "validation/samples/pointwise.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Curves for the report: the replay's error with its derived limit, how a deviation grows in each window, and the
/// distance to singular poses and to the workspace's edge along the path; and the events of the replay.
void addCurves(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
               ValidationResult& result);

/// Error against derivative evaluations, for the report.
TimeSeries workPrecision(const Ladder& ladder);

}  // namespace ursula
