#pragma once

#include "model/scenario.h"
#include "report/files/blocks.h"

namespace ursula {

/// Motion, joint motion and efforts at `samples` equally spaced instants from 0 to t_f, for `ursula inverse`. All are
/// the NOC's: `make` throws its PoseError.
BlockTable inverseBlocks(const Scenario& scenario, int samples);

}  // namespace ursula
