#pragma once

// Numbers and sentences that the audit's three formats share.

#include <string>
#include <vector>

#include "parts/audit/audit.h"
#include "parts/audit/reference_mechanism.h"

namespace ursula::audit {

/// Three digits; one digit for rounding errors; "—" for undefined values.
std::string number(double value);

/// "0.61 rad/s of 1.1": a residual and the size of its quantity.
std::string residualOf(double residual, const AuditRow& row);

/// Formats a time at which the replay was 1 mm or 10 mm off.
std::string instant(double t);

/// Says where the replay ended.
std::string ending(const AuditEffect& effect, double duration);

/// Statements of the text beside its formulas, measured if possible.
std::vector<AuditRemark> remarks(const Scenario& scenario, const ReferenceMechanism& mechanism,
                                 const std::vector<ReferenceState>& states);

}  // namespace ursula::audit
