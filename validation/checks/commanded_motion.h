#pragma once

#include <vector>

#include "model/exact_trajectory.h"
#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// What all formulations share, and so cannot hold against each other: the commanded motion and the load.
/// `motion.pose`, `.twist`, `.twist_rate`; `motion.load` where there is a load. Takes nothing from any solver's answer.
std::vector<Check> judgeCommandedMotion(const Scenario& scenario);

/// `motion.pose`, `.twist`, `.twist_rate`. `length`, of the machine, makes metres of angles.
std::vector<Check> judgeTrajectory(const Trajectory& trajectory, double length, const HiddenTerms& hidden);

}  // namespace ursula
