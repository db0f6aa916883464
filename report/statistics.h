#pragma once

#include <string>

#include "validation/verdict/result.h"

namespace ursula::report {

/// A table of the errors over time: maximum with its instant, root of the mean square, last, and a histogram of their
/// decades. Empty where there are no errors.
std::string statisticsTable(const ValidationResult& result);

}  // namespace ursula::report
