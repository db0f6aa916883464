#include "validation/samples/place_name.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/scalar.h"
#include "validation/subject/frame_change.h"

namespace ursula {

std::string motorName(const Units& units, int motor) {
  const std::string leg = placeName(units.legOf(motor), false);
  const auto& legs = units.efforts.leg;
  const bool alone = motor < 0 || std::count(legs.begin(), legs.end(), units.legOf(motor)) == 1;
  return alone ? leg : fmt::format("{}, motor {}", leg, motor + 1);
}

std::string placeName(int where, bool of_body) {
  if (where < 0) return "platform";
  if (!of_body) return fmt::format("leg {}", where + 1);
  if (where == 2 * leg_count) return "platform";
  return fmt::format("{} link of leg {}", where < leg_count ? "proximal" : "distal", where % leg_count + 1);
}

}  // namespace ursula
