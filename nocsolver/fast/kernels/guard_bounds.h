#pragma once

// What guards of doubles hold against, where no function of doubles may be made (chain_frame.h and platform_at_p.h have
// the same by the scalar's eps). Internal.

namespace ursula::kernel {

constexpr double root_eps = 0x1p-26;      ///< √eps: below it a sine or a lever has no correct digit left
constexpr double least_pivots = 0x1p-48;  ///< 16 eps: of the pivots of Bᵀ, the smallest over the largest

}  // namespace ursula::kernel
