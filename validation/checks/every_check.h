#pragma once

#include "validation/evidence/evidence.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Sorts the checks in the order of checkCatalogue() and adds those that do not apply, each with its reason.
void listEveryCheck(const Scenario& scenario, const SubjectHas& has, ValidationResult& result);

}  // namespace ursula
