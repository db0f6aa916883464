#pragma once

#include <limits>

#include "model/scenario_keys.h"

// Common parts of the lists of keys.

namespace ursula {

inline constexpr double least_positive = std::numeric_limits<double>::denorm_min();
inline constexpr KeyBound above_zero{"> 0", least_positive};
inline constexpr KeyBound not_negative{">= 0", 0};
inline constexpr KeyBound not_zero{"not 0", -std::numeric_limits<double>::max(), std::numeric_limits<double>::max(),
                                   false};
inline constexpr const char* required_key = "!";
inline constexpr const char* no_default = "";

}  // namespace ursula
