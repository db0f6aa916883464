// The solver in single precision, only for tests.

#include "nocsolver/legs/leg_model_impl.h"
#include "nocsolver/noc/noc_impl.h"
#include "parts/fast/fast_dynamics_impl.h"

namespace ursula {
template struct MachineParameters<float>;
template class Noc<float>;
template class FastDynamics<float>;
}  // namespace ursula
