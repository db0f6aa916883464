#pragma once

#include <optional>
#include <vector>

#include "validation/evidence/evidence.h"
#include "validation/verdict/result.h"

namespace ursula {

/// The largest deviation of the efforts over all checks of torques, judged or not, and what errors of that size would
/// do to the motion. `checks` are in SI. None where nothing was compared.
std::optional<EffortDeviation> effortDeviation(const Evidence& evidence, const std::vector<Check>& checks);

/// Where the scenario has a tolerance of the user's: the checks of torques are held against it, each by its largest
/// value, and what errors of that size do to accelerations and replays is reported, not judged, unless [acceptance]
/// names it. `between`: what the torques may be off by between the
/// instants at which they are given, in SI, infinite where they are not known over the whole motion. Where that is more
/// than the tolerance, what was not covered stays inconclusive.
void judgeByTolerance(const Scenario& scenario, double between, ValidationResult& result);

/// Throws ScenarioError where torques of zero would pass at the scenario's tolerance, unless it is `any`.
void requireTellingTolerance(const Scenario& scenario);

}  // namespace ursula
