#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "model/manipulator.h"

namespace ursula {

/// "tau_3_Nm", or "tau_3_N" if motor k, 0-based, slides.
inline std::string effortColumn(const Motors& motors, int k) {
  return fmt::format("tau_{}_{}", k + 1, motors[static_cast<std::size_t>(k)].effortUnit());
}

/// "Nm", or "N" if all motors slide, for texts about all of them. A force then counts as a moment at a length of 1 m.
inline const char* effortSuffix(const Motors& motors) {
  return std::all_of(motors.begin(), motors.end(), [](const Motor& motor) { return motor.slides(); }) ? "N" : "Nm";
}

}  // namespace ursula
