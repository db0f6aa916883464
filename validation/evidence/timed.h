#pragma once

#include "base/deadline.h"
#include "model/scenario.h"

namespace ursula {

/// The same scenario, whose motion throws OutOfTime once the deadline is over: every experiment asks for it again and
/// again, so that each ends where it stands. Without a deadline it is the scenario itself.
Scenario timed(const Scenario& scenario, const Deadline& deadline);

}  // namespace ursula
