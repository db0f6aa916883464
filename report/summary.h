#pragma once

#include <string>

#include "validation/verdict/result.h"

namespace ursula::report {

/// Returns the result with the run in its provenance, as files contain it: see run.h.
ValidationResult stamped(const ValidationResult& result);

/// `summary.json`. A number that is not finite becomes null; findings and provenance are ordered objects.
std::string summaryJson(const ValidationResult& result);

/// The summary of a scenario with an error: scenario, verdict "error" and error.
std::string errorJson(const std::string& scenario, const std::string& error);

}  // namespace ursula::report
