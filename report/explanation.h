#pragma once

#include <string>

namespace ursula::report {

/// The page of one check, in lines of at most 100 columns. Throws std::invalid_argument for one that is not known, with
/// the nearest that is.
std::string explanation(const std::string& check);

/// Every check with what it shows, in groups.
std::string explanations();

/// docs/checks.md: what every check proves and cannot see, where its limit comes from, and what to do when it fails.
std::string checksMarkdown();

}  // namespace ursula::report
