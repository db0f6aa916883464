#pragma once

#include <string>
#include <vector>

#include "validation/samples/engines.h"
#include "validation/subject/frame_change.h"
#include "validation/verdict/result.h"

namespace ursula {

/// The subject against each further formulation that this build has: `torque.twin`, `torque.maximal`, `torque.mujoco`.
/// `conditions`, at the same instants, say why a limit is wide; without them nothing does.
std::vector<Check> judgeEngines(const std::vector<EngineSample>& samples, const Units& units = {},
                                const std::vector<PointwiseSample>& conditions = {});

/// Which formulation stands alone when the others agree, in words; "none" where all agree.
std::string oddOneOut(const std::vector<EngineSample>& samples);

}  // namespace ursula
