#pragma once

#include "model/scenario.h"
#include "report/files/blocks.h"

namespace ursula {

/// Motion, joint motion and efforts at `samples` equally spaced instants from 0 to t_f, for `ursula inverse`. Joint
/// motion is Solver's; efforts are BatchDynamics' with the widest instruction set, so their last bits depend on the
/// processor. Solver refuses a pose that the batch flagged: `make` throws its PoseError.
BlockTable inverseBlocks(const Scenario& scenario, int samples);

}  // namespace ursula
