#pragma once

#include <vector>

#include "studies/audit/audit.h"
#include "studies/audit/witness.h"

namespace ursula::audit {

/// What the text says beside its formulas, measured where there is something to measure.
std::vector<AuditRemark> remarks(const Scenario& scenario, const WitnessStand& stand,
                                 const std::vector<Witness>& witnesses);

}  // namespace ursula::audit
