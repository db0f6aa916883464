#pragma once

#include <vector>

#include "base/deadline.h"
#include "model/scenario.h"

namespace ursula {

/// The observed order of the replay's integrator, by halving fixed steps twice over several stretches, the longest
/// first. Returns none if no stretch lies between rounding and too long steps. It uses the scenario's own loop from its
/// commanded state, but with smooth forces: no friction, no load, constant torques. `lower` uses an integrator of lower
/// order, as a negative control.
std::vector<double> observedOrders(const Scenario& scenario, bool lower = false, const Deadline& deadline = {});

/// Allowed shortfall of the observed order, because the machine's own scales matter over short but finite steps. A
/// lower order must also be settled over the shortest stretches, within the second value.
constexpr double largest_shortfall = 1.25, settled = 0.4;
constexpr int settled_over = 6;  ///< number of stretches; the shortest has half the length

/// The best order over the shorter half of the stretches, at least one.
double bestOrder(const std::vector<double>& orders);
/// Whether the shortest stretches agree.
bool haveSettled(const std::vector<double>& orders);

}  // namespace ursula
