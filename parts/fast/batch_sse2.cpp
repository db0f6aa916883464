#include "parts/fast/kernels/batch_block.h"

namespace ursula::kernel {
BatchFunctions batchBySse2() { return batchFunctions<xsimd::sse2>(); }
}  // namespace ursula::kernel
