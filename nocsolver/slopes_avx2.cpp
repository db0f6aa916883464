#include "nocsolver/kernels/slope_functions_impl.h"

namespace ursula::kernel {
SlopeFunctions slopesByAvx2() { return slopeFunctions<xsimd::fma3<xsimd::avx2>>(); }
}  // namespace ursula::kernel
