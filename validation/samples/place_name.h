#pragma once

#include <string>

namespace ursula {

struct Units;

/// "leg 3", or "leg 3, motor 5" for a leg with several motors; "platform" for −1. `motor` is 0-based.
std::string motorName(const Units& units, int motor);

/// "leg 3", "proximal link of leg 3" or "platform".
std::string placeName(int where, bool of_body);

}  // namespace ursula
