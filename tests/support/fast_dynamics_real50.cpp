// The fast kernels in 50 digits, for tests alone.

#include "base/real50.h"
#include "nocsolver/fast/fast_dynamics_impl.h"

namespace ursula {
template class FastDynamics<Real50>;
}
