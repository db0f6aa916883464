#pragma once

// Numbers and sentences that the audit's three forms share.

#include <string>

#include "studies/audit/audit.h"

namespace ursula::audit {

/// Three digits; one for what is rounding; "—" for what cannot be said.
std::string number(double value);

/// "0.61 rad/s of 1.1": a residual beside the size of what it is a residual of.
std::string residualOf(double residual, const AuditRow& row);

/// When the replay was that far off.
std::string instant(double t);

/// Where the replay ended.
std::string ending(const AuditEffect& effect, double duration);

}  // namespace ursula::audit
