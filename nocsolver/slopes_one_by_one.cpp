#include "nocsolver/kernels/state_slopes_impl.h"

namespace ursula::kernel {
SlopeFunctions slopesOneByOne() { return slopeFunctions<OneByOne>(); }
}  // namespace ursula::kernel
