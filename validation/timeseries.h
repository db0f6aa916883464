#pragma once

#include <vector>

#include "validation/judge_replay.h"
#include "validation/pointwise.h"
#include "validation/result.h"

namespace ursula {

/// Commanded and simulated motion, joint motion, torques and errors at the instants of `samples`, as interface.md names
/// the columns.
TimeSeries validationSeries(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows);

/// Motion, joint motion and torques alone: what `ursula inverse` prints.
TimeSeries inverseSeries(const std::vector<Motion<double>>& motions, const std::vector<JointMotion>& joints,
                         const std::vector<Vector6d>& torques);

/// Motion and torques: what `ursula simulate` prints.
TimeSeries simulatedSeries(const std::vector<Motion<double>>& motions, const std::vector<Vector6d>& torques);

}  // namespace ursula
