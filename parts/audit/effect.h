#pragma once

#include <functional>

#include "nocsolver/legs/reading.h"
#include "parts/audit/audit.h"

namespace ursula::audit {

using Torques = std::function<Vector6d(const Motion<double>&)>;

/// Returns the torques with `formula_errors`, by (37), or by (36) for formulas that only Ṫ needs.
Torques torquesWith(const Scenario& scenario, const WithFormulaErrors& formula_errors, bool only_in_36);

/// Compares torques and replay with those of the correct formulas, at `samples` instants.
AuditEffect effectOf(const Scenario& scenario, const Torques& torques, int samples, double replay_tolerance);

/// Returns the largest torque of the motion, N·m.
double largestTorque(const Scenario& scenario, int samples);

}  // namespace ursula::audit
