#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/report.h"

namespace ursula::report {

/// A result as one would paste it into a mail: the checks in groups, each with value, limit, unit and share, a line of
/// why under what did not pass, what does not apply with its reason, which motors are off, and the verdict.
std::string validationText(const ValidationResult& result, bool coloured);

/// The verdict in a line; under it a line for each check that failed or cannot be judged, and the likely cause.
std::string quietText(const ValidationResult& result, bool coloured);
std::string quietText(const SuiteEntry& entry, bool coloured);

/// A line for each scenario in the order given, then the totals. `dir` holds their folders.
std::string suiteText(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir, bool coloured);

/// Whether to colour: on a terminal only, not with NO_COLOR set and not empty, not on a dumb one. Null: not set.
bool wantsColour(bool is_terminal, const char* no_color, const char* term);

}  // namespace ursula::report
