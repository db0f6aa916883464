#include "nocsolver/kernels/slope_functions_impl.h"

namespace ursula::kernel {
SlopeFunctions slopesOneByOne() { return slopeFunctions<OneByOne>(); }
}  // namespace ursula::kernel
