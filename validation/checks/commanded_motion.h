#pragma once

#include <vector>

#include "model/exact_trajectory.h"
#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Checks the commanded motion and the load, which all formulations share and so cannot check: `motion.pose`, `.twist`,
/// `.twist_rate`, and `motion.load` if there is a load. It uses no solver's results.
std::vector<Check> judgeCommandedMotion(const Scenario& scenario);

/// `motion.pose`, `.twist`, `.twist_rate`. The machine's `length` converts angles to metres.
std::vector<Check> judgeTrajectory(const Trajectory& trajectory, double length, const HiddenTerms& hidden);

}  // namespace ursula
