#pragma once

#include <string>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula::report {

/// Returns a verdict as a sign and its word, so that colour is not essential.
std::string verdictBadge(Verdict verdict);

/// Returns the checks in groups; groups with open issues come first and are unfolded. Each check has a bar of value
/// over limit on a logarithmic scale. Folded below are its meaning, its result and the origin of its limit. Needs no
/// script. `cause`, the likely cause, appears elsewhere and is removed from the results.
std::string checksList(const std::vector<Check>& checks, const std::string& cause = "");

}  // namespace ursula::report
