#pragma once

#include <vector>

#include "validation/replay/windowed_replay.h"
#include "validation/samples/pointwise.h"
#include "validation/samples/reaction_samples.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Commanded and simulated motion, joint motion, torques and errors at the instants of `samples`, as interface.md names
/// the columns.
TimeSeries validationSeries(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows);

/// Adds the recovered joint reactions, a row for each sample.
void addReactionColumns(const std::vector<ReactionSample>& reactions, TimeSeries& series);

/// Motion, joint motion and torques alone: what `ursula inverse` prints.
TimeSeries inverseSeries(const std::vector<Motion<double>>& motions, const std::vector<JointMotion>& joints,
                         const std::vector<Vector6d>& torques);

/// Motion and torques: what `ursula simulate` prints.
TimeSeries simulatedSeries(const std::vector<Motion<double>>& motions, const std::vector<Vector6d>& torques);

}  // namespace ursula
