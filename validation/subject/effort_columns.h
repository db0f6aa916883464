#pragma once

#include <fmt/format.h>

#include <string>

#include "model/manipulator.h"

namespace ursula {

/// "tau_3_Nm", or "tau_3_N" where motor k, 0-based, slides.
inline std::string effortColumn(const Motors& motors, int k) {
  return fmt::format("tau_{}_{}", k + 1, motors[static_cast<std::size_t>(k)].effortUnit());
}

}  // namespace ursula
