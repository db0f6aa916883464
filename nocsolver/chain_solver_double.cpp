#include "nocsolver/chain_solver_impl.h"

namespace ursula {
template class ChainSolver<double>;
template class ChainSolver<float>;
}  // namespace ursula
