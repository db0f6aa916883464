#include "parts/fast/fast_dynamics_impl.h"

namespace ursula {
template class FastDynamics<double>;
}  // namespace ursula
