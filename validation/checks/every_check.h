#pragma once

#include "validation/evidence/evidence.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Puts the checks into the order of checkCatalogue() and adds those that do not apply, each with its reason.
void listEveryCheck(const Scenario& scenario, const SubjectHas& has, ValidationResult& result);

}  // namespace ursula
