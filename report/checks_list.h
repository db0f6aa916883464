#pragma once

#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

/// A verdict as a sign and its word, so that nothing hangs on colour.
std::string verdictBadge(Verdict verdict);

/// The checks in groups, those with something to see to first and open; each check with a bar of value against limit
/// on a logarithmic scale and, folded, what it means, what was found and where the limit comes from. Needs no script.
/// `cause`, the likely one, is said elsewhere and left out of what was found.
std::string checksList(const std::vector<Check>& checks, const std::string& cause = "");

}  // namespace ursula::report
