#pragma once

#include "model/scenario.h"
#include "validation/result.h"

namespace ursula {

/// `integration.order`: the order of the replay's integrator, found by halving fixed steps. On the scenario's own loop,
/// from its commanded state, but where everything is smooth: without friction and load, and under torques that do not
/// change.
Check judgeOrder(const Scenario& scenario);

}  // namespace ursula
