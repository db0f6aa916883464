#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/files/report.h"

namespace ursula::report {

/// Returns a result as text for a mail: verdict, size of the deviation and cause; then a line for each group of checks,
/// with those that did not pass and why; then details of wrong motors. `verbose` gives all checks with value, limit,
/// unit and share, and the reasons of those that do not apply.
std::string validationText(const ValidationResult& result, bool coloured, bool verbose = false);

/// Returns the verdict, the worst motor and the likely cause in one line.
std::string quietText(const ValidationResult& result, bool coloured);
std::string quietText(const SuiteEntry& entry, bool coloured);

/// Returns a line per scenario in the given order, then the totals. `dir` contains their folders.
std::string suiteText(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir, bool coloured);

/// Whether to use colour: only on a terminal that is not dumb, and unless NO_COLOR is set and non-empty. Null means not
/// set.
bool wantsColour(bool is_terminal, const char* no_color, const char* term);

}  // namespace ursula::report
