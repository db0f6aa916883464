#pragma once

#include <string>

namespace ursula {

/// "leg 3", "proximal link of leg 3" or "platform".
std::string placeName(int where, bool of_body);

}  // namespace ursula
