#include "validation/samples/place_name.h"

#include <fmt/format.h>

#include "model/scalar.h"

namespace ursula {

std::string placeName(int where, bool of_body) {
  if (where < 0) return "platform";
  if (!of_body) return fmt::format("leg {}", where + 1);
  if (where == 2 * leg_count) return "platform";
  return fmt::format("{} link of leg {}", where < leg_count ? "proximal" : "distal", where % leg_count + 1);
}

}  // namespace ursula
