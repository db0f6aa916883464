#pragma once

#include <string>

#include "validation/verdict/result.h"

namespace ursula::report {

/// Returns a table of the errors over time: maximum with its instant, root mean square, last value, and a histogram of
/// their decades. Empty if there are no errors.
std::string statisticsTable(const ValidationResult& result);

}  // namespace ursula::report
