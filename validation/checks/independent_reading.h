#pragma once

#include "model/scenario.h"
#include "validation/checks/file_as_written.h"
#include "validation/checks/mismatches.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `motion.reading`: the numbers of the scenario as read against those of its file, read a second time. An error here
/// would be the same on every formulation.
Check judgeReading(const Scenario& scenario, const FileAsWritten& written);

/// Its part for the motion: poses at the instants that the file names, and what else pins its numbers.
void compareTrajectory(const Trajectory& trajectory, const TrajectoryAsWritten& written, Mismatches& mismatches);

}  // namespace ursula
