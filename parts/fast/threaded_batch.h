#pragma once

#include "parts/fast/batch_dynamics.h"

namespace ursula {

// BatchDynamics on several threads (oneTBB). Results equal those of one thread to the last bit. Arguments are those of
// BatchDynamics. At most `jobs` threads work, including the caller, and no more than the processor has. 0 means as many
// as the caller's TBB arena allows, by default all. Only TBB allocates; it is not used for fewer than 512 poses or for
// one job. Any thread may call these.

/// Efforts as BatchDynamics::inverseDynamics.
void inverseDynamics(const BatchDynamics& batch, const Motion<double>* motions, std::size_t count, Vector6d* efforts,
                     PoseFault* faults, const Vector6d* loads = nullptr, int jobs = 0);

/// Twist rates [ω̇; p̈] as BatchDynamics::directDynamics.
void directDynamics(const BatchDynamics& batch, const Motion<double>* motions, const Vector6d* efforts,
                    std::size_t count, Vector6d* twist_rates, PoseFault* faults, const Vector6d* loads = nullptr,
                    int jobs = 0);

}  // namespace ursula
