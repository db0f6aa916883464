#include "nocsolver/paper_solver_impl.h"

namespace ursula {
template class PaperSolver<double, Corrected>;
template class PaperSolver<float, Corrected>;
}  // namespace ursula
