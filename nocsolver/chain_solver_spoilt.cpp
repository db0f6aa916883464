#include "nocsolver/chain_solver_impl.h"

namespace ursula {
template class ChainSolver<double, SpoiltChain>;
}  // namespace ursula
