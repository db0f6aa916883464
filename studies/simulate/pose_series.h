#pragma once

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Returns the points for a drawing of the machine at `count` equally spaced instants: `t_s`, `p_{x,y,z}_m` and, for
/// each leg, `A_{1..6}_{x,y,z}_m` at the base, `R_…` at the knee and `B_…` at the platform, in B. Throws PoseError.
TimeSeries poseSeries(const Scenario& scenario, int count);

}  // namespace ursula
