// The fast kernels in 50 digits, only for tests.

#include "base/real50.h"
#include "parts/fast/fast_dynamics_impl.h"

namespace ursula {
template class FastDynamics<Real50>;
}
