#pragma once

#include <cstdlib>

namespace ursula {

/// Whether all cases shall be tried (./dev prove); ./dev test takes a part of them.
inline bool wholeAsked() { return std::getenv("URSULA_WHOLE") != nullptr; }

}  // namespace ursula
