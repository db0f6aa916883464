#include "nocsolver/kernels/state_slopes_impl.h"

namespace ursula::kernel {
SlopeFunctions slopesBySse2() { return slopeFunctions<xsimd::sse2>(); }
}  // namespace ursula::kernel
