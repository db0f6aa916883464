#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/replay/ladder.h"
#include "validation/replay/windowed_replay.h"
#include "validation/samples/pointwise.h"
#include "validation/samples/simbody_samples.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// The sample with the largest condition number of B, and the one with the smallest |sin θ| of a knee. Need a sample.
const PointwiseSample& nearestToSingular(const std::vector<PointwiseSample>& samples);
const PointwiseSample& nearestToEdge(const std::vector<PointwiseSample>& samples);

/// Adds curves for the report: the replay's error with its derived limit, and the growth of a deviation in each window.
/// Further ones are the distances to singular poses and to the workspace's edge. Adds the replay's events.
void addCurves(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
               ValidationResult& result);

/// Error over derivative evaluations, for the report.
TimeSeries workPrecision(const Ladder& ladder);

/// Adds the largest torque and acceleration with their errors, condition numbers, and the cost of the replay.
void addFindings(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                 ValidationResult& result, const Units& units = {});

/// Converts series and curves from a change of frame's units and origin to SI and B, by the names of their columns.
void seriesInSi(const FrameChange& from, ValidationResult& result);

/// Adds scenario, subject, build and settings.
void addProvenance(const Scenario& scenario, const std::string& subject, ValidationResult& result);

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
