#pragma once

#include "nocsolver/fast/batch_dynamics.h"

namespace ursula {

// BatchDynamics by several threads (oneTBB). Every number is that of one thread, to the last bit. Arguments are those
// of BatchDynamics; `jobs` is how many threads work at once at most, the calling one among them: no more than the
// processor has, and 0 for as many as the caller's own TBB arena allows, by default all. Nothing is allocated but by
// TBB itself, and for fewer than 512 poses or one job TBB is not asked. Threads share everything here.

/// Efforts as BatchDynamics::inverseDynamics.
void inverseDynamics(const BatchDynamics& batch, const Motion<double>* motions, std::size_t count, Vector6d* efforts,
                     PoseFault* faults, const Vector6d* loads = nullptr, int jobs = 0);

/// Twist rates [ω̇; p̈] as BatchDynamics::directDynamics.
void directDynamics(const BatchDynamics& batch, const Motion<double>* motions, const Vector6d* efforts,
                    std::size_t count, Vector6d* twist_rates, PoseFault* faults, const Vector6d* loads = nullptr,
                    int jobs = 0);

}  // namespace ursula
