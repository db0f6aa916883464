#include "parts/fast/kernels/batch_block.h"

namespace ursula::kernel {
BatchFunctions batchByAvx2() { return batchFunctions<xsimd::fma3<xsimd::avx2>>(); }
}  // namespace ursula::kernel
