#include "model/real50.h"
#include "nocsolver/solver_impl.h"

namespace ursula {
template class Solver<double, WithSlips>;
template class Solver<Real50, WithSlips>;
}  // namespace ursula
