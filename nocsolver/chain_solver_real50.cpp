#include "model/real50.h"
#include "nocsolver/chain_solver_impl.h"

namespace ursula {
template class ChainSolver<Real50>;
}  // namespace ursula
