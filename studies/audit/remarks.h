#pragma once

#include <vector>

#include "studies/audit/audit.h"
#include "studies/audit/witness.h"

namespace ursula::audit {

/// Statements of the text beside its formulas, measured if possible.
std::vector<AuditRemark> remarks(const Scenario& scenario, const WitnessStand& stand,
                                 const std::vector<Witness>& witnesses);

}  // namespace ursula::audit
