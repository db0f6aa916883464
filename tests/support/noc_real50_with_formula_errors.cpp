// The formulas as printed in 50 digits, only for tests.

#include "base/real50.h"
#include "nocsolver/noc/noc_joints_impl.h"

namespace ursula {
template class Noc<Real50, WithFormulaErrors>;
}  // namespace ursula
