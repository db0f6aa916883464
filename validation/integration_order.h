#pragma once

#include "model/scenario.h"
#include "validation/result.h"

namespace ursula {

/// `integration.order`: the order of the replay's integrator, found by halving fixed steps. On the scenario's own loop,
/// from its commanded state, but where everything is smooth: without friction and load, and under torques that do not
/// change.
/// `lower`: of an integrator of lower order instead, a control that must fail.
Check judgeOrder(const Scenario& scenario, bool lower = false);

}  // namespace ursula
