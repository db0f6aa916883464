#include "validation/checks/judges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/replay/observed_order.h"
#include "validation/replay/replay.h"

namespace ursula {
Check judgeOrder(const std::vector<double>& orders) {
  static constexpr const char* check = "integration.order";
  const std::string basis = fmt::format(
      "as far as steps that have not vanished leave it open; it fails where the shortest {} stretches agree to {:g}",
      settled_over, settled);
  if (orders.empty())
    return notJudgeable(Reason::limit_useless, check, std::nan(""), largest_shortfall, "", basis,
                        "no stretch of the motion is between rounding and steps too long to show an order");
  const double order = bestOrder(orders), shortfall = std::max(0.0, nominal_order - order);
  const std::string why = fmt::format(
      "observed order {:.3g}, of {:g}, by halving fixed steps twice: the best over the shorter half of {} stretches, "
      "without friction and load",
      order, nominal_order, orders.size());
  if (shortfall > largest_shortfall && !haveSettled(orders))
    return notJudgeable(Reason::limit_useless, check, shortfall, largest_shortfall, "", basis,
                        why + "; the orders have not settled: rounding is met before the steps are short enough");
  return judged(check, shortfall, largest_shortfall, "", basis, why);
}

}  // namespace ursula
