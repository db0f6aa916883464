#include "nocsolver/solver_impl.h"

namespace ursula {
template class Solver<Real50, Corrected>;
}  // namespace ursula
