#pragma once

#include <string>

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Adds scenario, subject, build and settings.
void addProvenance(const Scenario& scenario, const std::string& subject, ValidationResult& result);

}  // namespace ursula
