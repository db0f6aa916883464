// The NOC in 50 digits and in long double, for reference values.

#include "base/real50.h"
#include "nocsolver/legs/leg_model_impl.h"
#include "nocsolver/noc/noc_impl.h"

namespace ursula {
template struct MachineParameters<Real50>;
template class Noc<Real50>;
template struct MachineParameters<long double>;
template class Noc<long double>;
}  // namespace ursula
