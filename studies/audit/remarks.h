#pragma once

#include <vector>

#include "studies/audit/audit.h"
#include "studies/audit/reference_mechanism.h"

namespace ursula::audit {

/// Statements of the text beside its formulas, measured if possible.
std::vector<AuditRemark> remarks(const Scenario& scenario, const ReferenceMechanism& mechanism,
                                 const std::vector<ReferenceState>& states);

}  // namespace ursula::audit
