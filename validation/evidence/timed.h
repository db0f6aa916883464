#pragma once

#include "base/deadline.h"
#include "model/scenario.h"

namespace ursula {

/// Returns the scenario with a motion that throws OutOfTime after the deadline. Every experiment calls the motion
/// often, so it ends soon. Without a deadline it is the scenario itself.
Scenario timed(const Scenario& scenario, const Deadline& deadline);

}  // namespace ursula
