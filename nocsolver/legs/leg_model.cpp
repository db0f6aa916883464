#include "nocsolver/legs/leg_model_impl.h"

namespace ursula {

template struct MachineParameters<double>;
template struct MachineParameters<long double>;

}  // namespace ursula
