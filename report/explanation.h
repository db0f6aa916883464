#pragma once

#include <string>

namespace ursula::report {

/// Returns the page of one check, in lines of at most 100 columns. Throws std::invalid_argument for an unknown check,
/// with the nearest known one.
std::string explanation(const std::string& check);

/// Returns every check with its meaning, in groups.
std::string explanations();

/// docs/checks.md: what every check proves and cannot see, the origin of its limit, and what to do after a failure.
std::string checksMarkdown();

}  // namespace ursula::report
