#pragma once

#include "model/scenario.h"
#include "studies/stream/blocks.h"

namespace ursula {

/// Motion, joint motion and efforts at `samples` equally spaced instants from 0 to t_f, what `ursula inverse` writes.
/// Joint motion is Solver's, efforts are BatchDynamics' by the widest instruction set: their last bits are those of the
/// processor. A pose that the batch has flagged is Solver's to refuse: `make` throws its PoseError.
BlockTable inverseBlocks(const Scenario& scenario, int samples);

}  // namespace ursula
