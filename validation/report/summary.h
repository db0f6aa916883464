#pragma once

#include <string>

#include "validation/verdict/result.h"

namespace ursula::report {

/// `summary.json`. A number that is not finite becomes null; findings and provenance are objects in their own order.
std::string summaryJson(const ValidationResult& result);

}  // namespace ursula::report
