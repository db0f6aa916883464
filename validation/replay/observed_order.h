#pragma once

#include <vector>

#include "model/scenario.h"

namespace ursula {

/// The order of the replay's integrator, found by halving fixed steps twice over each of several stretches, from the
/// longest on; empty where none is between rounding and steps too long to show an order. On the scenario's own loop,
/// from its commanded state, but where everything is smooth: without friction and load, and under torques that do not
/// change. `lower`: of an integrator of lower order instead, a control that must fail.
std::vector<double> observedOrders(const Scenario& scenario, bool lower = false);

}  // namespace ursula
