#include "nocsolver/kernels/slope_functions_impl.h"

namespace ursula::kernel {
SlopeFunctions slopesByAvx512() { return slopeFunctions<xsimd::avx512bw>(); }
}  // namespace ursula::kernel
