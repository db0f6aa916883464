#pragma once

#include <vector>

#include "validation/replay/windowed_replay.h"
#include "validation/samples/pointwise.h"
#include "validation/samples/reaction_samples.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Commanded and simulated motion, joint motion, efforts and errors at the instants of `samples`, as interface.md names
/// the columns: joints that the legs have, an effort for each motor.
TimeSeries validationSeries(const Manipulator& machine, const std::vector<PointwiseSample>& samples,
                            const std::vector<WindowedReplay>& windows);

/// Adds the recovered joint reactions, a row for each sample.
void addReactionColumns(const Manipulator& machine, const std::vector<ReactionSample>& reactions, TimeSeries& series);

/// Motion, joint motion and efforts alone: what `ursula inverse` prints.
TimeSeries inverseSeries(const Manipulator& machine, const std::vector<Motion<double>>& motions,
                         const std::vector<JointMotion>& joints, const std::vector<Vector6d>& efforts);

/// Motion and efforts: what `ursula simulate` prints.
TimeSeries simulatedSeries(const Manipulator& machine, const std::vector<Motion<double>>& motions,
                           const std::vector<Vector6d>& efforts);

}  // namespace ursula
