#pragma once

#include <optional>
#include <vector>

#include "model/scenario.h"
#include "model/trajectory.h"
#include "validation/verdict/result.h"

namespace ursula {

/// What all formulations share, and so cannot hold against each other: the commanded motion, the load, the numbers as
/// read. `motion.pose`, `.twist`, `.twist_rate`; `motion.load` where there is a load; `motion.reading` where the
/// scenario has the text of a file. Takes nothing from any solver's answer.
std::vector<Check> judgeCommandedMotion(const Scenario& scenario);

/// Sizes that are added up on the way to a pose and that the pose does not show: a helix's angles, and their heights.
struct HiddenTerms {
  double angle = 6.2831853071795864769;  ///< rad; where nothing is known, a turn
  double length = 0;                     ///< m
};

/// `motion.pose`, `.twist`, `.twist_rate`. `length`, of the machine, makes metres of angles.
std::vector<Check> judgeTrajectory(const Trajectory& trajectory, double length, const HiddenTerms& hidden);

}  // namespace ursula
