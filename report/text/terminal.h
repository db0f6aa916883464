#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/files/report.h"

namespace ursula::report {

/// Returns the verdict, the worst motor and the likely cause in one line.
std::string quietText(const ValidationResult& result, bool coloured);
std::string quietText(const SuiteEntry& entry, bool coloured);

/// Returns a line per scenario in the given order, then the totals. `dir` contains their folders.
std::string suiteText(const std::vector<SuiteEntry>& entries, const std::filesystem::path& dir, bool coloured);

/// Returns the mistakes, those with one sentence but for the body's or joint's name as one that names all.
std::vector<BlindSpot> alikeAsOne(const std::vector<BlindSpot>& blind);

/// Returns lines of mistakes that a scenario cannot show: the first few, one of each term.
std::string blindText(const std::vector<BlindSpot>& blind);

/// Whether to use colour: only on a terminal that is not dumb, and unless NO_COLOR is set and non-empty. Null means not
/// set.
bool wantsColour(bool is_terminal, const char* no_color, const char* term);

}  // namespace ursula::report
