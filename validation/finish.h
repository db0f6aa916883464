#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/judge_replay.h"
#include "validation/pointwise.h"
#include "validation/result.h"

namespace ursula {

/// Judges by the scenario's own limits where it has any; naming a check that was not made is a failure.
void applyAcceptance(const std::vector<AcceptanceLimit>& acceptance, std::vector<Check>& checks);

/// Scenario, subject, build and settings.
void addProvenance(const Scenario& scenario, const std::string& subject, ValidationResult& result);

/// Largest torque and acceleration with their errors, condition numbers, and what the replay took.
void addFindings(const std::vector<PointwiseSample>& samples, const std::vector<WindowedReplay>& windows,
                 ValidationResult& result);

}  // namespace ursula
