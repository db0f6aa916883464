#pragma once

#include <vector>

#include "model/scenario.h"

namespace ursula {

/// The order of the replay's integrator, found by halving fixed steps twice over each of several stretches, from the
/// longest on; empty where none is between rounding and steps too long to show an order. On the scenario's own loop,
/// from its commanded state, but where everything is smooth: without friction and load, and under torques that do not
/// change. `lower`: of an integrator of lower order instead, a control that must fail.
std::vector<double> observedOrders(const Scenario& scenario, bool lower = false);

/// By which the observed order may be lower: what a machine's own scales leave open over steps that are short but not
/// yet vanishing. Where it is lower, it must also be settled, within the other over the shortest stretches.
constexpr double largest_shortfall = 1.25, settled = 0.4;
constexpr int settled_over = 6;  ///< stretches: half as long at their shortest

/// The best over the shorter half of the stretches, at least one.
double bestOrder(const std::vector<double>& orders);
/// The shortest stretches agree.
bool haveSettled(const std::vector<double>& orders);

}  // namespace ursula
