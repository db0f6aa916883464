#include "nocsolver/legs/leg_model_impl.h"

namespace ursula {

template struct MachineParameters<double>;

}  // namespace ursula
