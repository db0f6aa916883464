#pragma once

#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

/// A verdict as a sign and its word, so that nothing hangs on colour.
std::string verdictBadge(Verdict verdict);

/// The table of checks, those that did not pass first; under each a row with what was found and the limit's basis.
std::string checksTable(const std::vector<Check>& checks);

}  // namespace ursula::report
