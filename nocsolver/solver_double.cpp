#include "nocsolver/solver_impl.h"

namespace ursula {
template class Solver<double, Corrected>;
template class Solver<float, Corrected>;
}  // namespace ursula
