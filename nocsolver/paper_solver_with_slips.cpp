#include "model/real50.h"
#include "nocsolver/paper_solver_impl.h"

namespace ursula {
template class PaperSolver<double, WithSlips>;
template class PaperSolver<Real50, WithSlips>;
}  // namespace ursula
