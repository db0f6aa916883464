#pragma once

// Bounds of the guards in doubles, for sources that may define no function of doubles. chain_frame.h and
// platform_at_p.h compute the same from the scalar's eps. Internal.

namespace ursula::kernel {

constexpr double root_eps = 0x1p-26;      ///< √eps: a smaller sine or lever has no correct digit left
constexpr double least_pivots = 0x1p-48;  ///< 16 eps: least ratio of the smallest to the largest pivot of Bᵀ

}  // namespace ursula::kernel
