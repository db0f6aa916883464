#include "parts/fast/kernels/batch_block.h"

namespace ursula::kernel {
BatchFunctions batchByAvx512() { return batchFunctions<xsimd::avx512bw>(); }
}  // namespace ursula::kernel
