#include "nocsolver/noc/noc_joints_impl.h"

namespace ursula {
template class Noc<double, WithFormulaErrors>;
}  // namespace ursula
