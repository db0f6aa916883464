#pragma once

#include <vector>

#include "validation/verdict/result.h"

namespace ursula {

/// `integration.order` compares the orders from observedOrders() with the nominal one of the replay's integrator.
Check judgeOrder(const std::vector<double>& orders);

}  // namespace ursula
