#pragma once

#include <string>
#include <vector>

#include "validation/samples/roads.h"
#include "validation/subject/presentation.h"
#include "validation/verdict/result.h"

namespace ursula {

/// The subject against each further road that this build has: `torque.twin`, `torque.maximal`, `torque.mujoco`.
std::vector<Check> judgeRoads(const std::vector<RoadSample>& samples, const Units& units = {});

/// Which road stands alone when the others agree, in words; "none" where all agree.
std::string oddOneOut(const std::vector<RoadSample>& samples);

}  // namespace ursula
