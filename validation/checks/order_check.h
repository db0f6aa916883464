#pragma once

#include <vector>

#include "validation/verdict/result.h"

namespace ursula {

/// `integration.order`: the orders that observedOrders() finds, against the nominal one of the replay's integrator.
Check judgeOrder(const std::vector<double>& orders);

}  // namespace ursula
