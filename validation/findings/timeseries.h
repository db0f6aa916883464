#pragma once

#include <vector>

#include "validation/replay/windowed_replay.h"
#include "validation/samples/pointwise.h"
#include "validation/samples/reaction_samples.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Commanded and simulated motion, joint motion, efforts and errors at the instants of `samples`, with the columns of
/// interface.md. It has only joints that the legs have, and one effort per motor.
TimeSeries validationSeries(const Manipulator& machine, const std::vector<PointwiseSample>& samples,
                            const std::vector<WindowedReplay>& windows);

/// Adds the computed joint reactions, one row per sample.
void addReactionColumns(const Manipulator& machine, const std::vector<ReactionSample>& reactions, TimeSeries& series);

/// Motion, joint motion and efforts only, for `ursula inverse`.
TimeSeries inverseSeries(const Manipulator& machine, const std::vector<Motion<double>>& motions,
                         const std::vector<JointMotion>& joints, const std::vector<Vector6d>& efforts);

/// Motion and efforts, for `ursula simulate`.
TimeSeries simulatedSeries(const Manipulator& machine, const std::vector<Motion<double>>& motions,
                           const std::vector<Vector6d>& efforts);

}  // namespace ursula
