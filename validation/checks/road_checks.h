#pragma once

#include <string>
#include <vector>

#include "validation/samples/roads.h"
#include "validation/subject/presentation.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `torque.twin`, `torque.maximal`, and `torque.mujoco` where MuJoCo is built in: the subject against each further
/// road.
std::vector<Check> judgeRoads(const std::vector<RoadSample>& samples, const Units& units = {});

/// Which road stands alone when the others agree, in words; "none" where all agree.
std::string oddOneOut(const std::vector<RoadSample>& samples);

}  // namespace ursula
