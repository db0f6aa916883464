#include "nocsolver/kernels/slope_functions_impl.h"

namespace ursula::kernel {
SlopeFunctions slopesBySse2() { return slopeFunctions<xsimd::sse2>(); }
}  // namespace ursula::kernel
