#pragma once

#include <string>

#include "validation/verdict/result.h"

namespace ursula::report {

/// With the run in its provenance, as files have it: see run.h.
ValidationResult stamped(const ValidationResult& result);

/// `summary.json`. A number that is not finite becomes null; findings and provenance are objects in their own order.
std::string summaryJson(const ValidationResult& result);

/// What stands in a summary's place for a scenario that is in error: scenario, verdict "error" and error.
std::string errorJson(const std::string& scenario, const std::string& error);

}  // namespace ursula::report
