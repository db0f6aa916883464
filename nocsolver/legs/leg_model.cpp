#include "base/real50.h"
#include "nocsolver/legs/leg_model_impl.h"

namespace ursula {

template struct MachineParameters<float>;
template struct MachineParameters<double>;
template struct MachineParameters<long double>;
template struct MachineParameters<Real50>;

}  // namespace ursula
