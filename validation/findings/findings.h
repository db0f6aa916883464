#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/mechanism_scenario.h"
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
               const FrameChange& from, ValidationResult& result);

/// Error over derivative evaluations, for the report.
Curve workPrecision(const Ladder& ladder, const Units& units = {});

/// Adds the largest torque and acceleration with their errors, condition numbers, and the cost of the replay.
void addFindings(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                 ValidationResult& result, const Units& units = {});

/// Versions and settings of the parts in this build, by their names. CMake writes the definition (cmake/parts.cmake),
/// once for each program.
std::vector<std::pair<std::string, std::string>> partProvenance();

/// A result without checks, and without rows in its series. Its provenance has scenario, subject, build, settings and
/// what the user asked for.
ValidationResult emptyResult(const Scenario& scenario, const JudgedSubject& subject);
ValidationResult emptyResult(const MechanismScenario& scenario, const JudgedSubject& subject);

/// How large wrong efforts are, and which other idealisation of the legs makes them right; evaluated with the NOC and
/// Simbody. `scenario` and `samples` are in the units of `natural`, `given` in SI. Returns nullopt if no effort is
/// beyond its limit. Needs the result's deviation and cause.
std::optional<FailureSize> failureSize(const Scenario& scenario, const std::vector<PointwiseSample>& samples,
                                       const Scenario& given, const FrameChange& natural,
                                       const ValidationResult& result);

/// Commanded and simulated motion, joint motion, efforts and errors at the instants of `samples`, with the columns of
/// docs/csv.md. It has only joints that the legs have, and one effort per motor.
TimeSeries validationSeries(const Manipulator& machine, const std::vector<PointwiseSample>& samples,
                            const std::vector<WindowedReplay>& windows, const FrameChange& from = {});

/// Adds the computed joint reactions, one row per sample.
void addReactionColumns(const Manipulator& machine, const std::vector<ReactionSample>& reactions,
                        const FrameChange& from, TimeSeries& series);

/// Motion, joint motion and efforts only, for `ursula inverse`.
TimeSeries inverseSeries(const Manipulator& machine, const std::vector<Motion<double>>& motions,
                         const std::vector<JointMotion>& joints, const std::vector<Vector6d>& efforts);

/// Motion and efforts, for `ursula simulate`.
TimeSeries simulatedSeries(const Manipulator& machine, const std::vector<Motion<double>>& motions,
                           const std::vector<Vector6d>& efforts);

}  // namespace ursula
