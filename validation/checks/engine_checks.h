#pragma once

#include <string>
#include <vector>

#include "validation/samples/engines.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Compares the subject with each further formulation of this build: `torque.twin`, `torque.maximal`, `torque.mujoco`.
/// `conditions`, at the same instants, explain wide limits; without them nothing does.
std::vector<Check> judgeEngines(const std::vector<EngineSample>& samples, const Units& units = {},
                                const std::vector<PointwiseSample>& conditions = {});

/// Returns in words which formulation disagrees with all others; "none" if all agree.
std::string oddOneOut(const std::vector<EngineSample>& samples);

}  // namespace ursula
