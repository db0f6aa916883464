#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/evidence/evidence.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Applies the scenario's own limits, each to the largest value of its check, and sets the verdict. A user's limit
/// decides an unjudged check only if that check lacked a useful limit. A limit for a check that was not made is a
/// failure.
void judgeByUser(const std::vector<AcceptanceLimit>& acceptance, ValidationResult& result);

/// Applies a user's limit to one check; `whose` names its basis. For an unfinished check only the words change.
void judgeByUser(double limit, const std::string& whose, Check& check);

/// Returns the largest deviation of the efforts over all checks of torques, judged or not, and its effect on the
/// motion. `checks` are in SI. Checks against the odd engine stand apart. Returns nullopt if nothing was compared.
std::optional<EffortDeviation> effortDeviation(const Evidence& evidence, const std::vector<Check>& checks,
                                               const OddOne& odd_one = {});

/// Takes a check's largest deviation, unless one of `any` before it was as large, and what the check sees.
void takeLargest(const Check& check, bool& any, EffortDeviation& out);
void takeBetween(const std::vector<Check>& checks, EffortDeviation& out);

/// Applies the user's tolerance, if there is one, to the largest value of each check of torques. The effect of
/// such errors on accelerations and replays is reported but not judged, unless [acceptance] names it. `between` is the
/// possible error between the given instants, in SI, or infinite if the torques do not cover the motion. If it exceeds
/// the tolerance, the uncovered part stays inconclusive.
void judgeByTolerance(const std::optional<EffortTolerance>& tolerance, const std::vector<AcceptanceLimit>& acceptance,
                      double between, ValidationResult& result);

/// Lists every check, applies the user's tolerance and limits, and sets the verdict. `between` is that of
/// judgeByTolerance.
void conclude(const Scenario& scenario, const SubjectHas& has, double between, ValidationResult& result);

/// Throws ScenarioError if zero torques would pass at the scenario's tolerance, unless it is `any`.
void requireTellingTolerance(const Scenario& scenario);
/// The same for a scenario of this name. `noun` is what its efforts are called, `largest` the largest of the motion.
void requireTellingTolerance(const EffortTolerance& tolerance, const std::string& scenario, const std::string& noun,
                             const std::string& unit, double largest);

}  // namespace ursula
