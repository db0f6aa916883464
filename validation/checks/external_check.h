#pragma once

#include "validation/evidence/external_torques.h"
#include "validation/verdict/result.h"

namespace ursula {

/// `torque.against_noc`: external torques against this program's own.
Check judgeAgainstNoc(const ExternalTorques& torques, const Units& units = {});

}  // namespace ursula
