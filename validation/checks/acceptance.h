#pragma once

#include <vector>

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Judges by the scenario's own limits where it has any, each held against the largest value of its check, and sets the
/// verdict. Of what could not be judged a limit of the user's lifts only what had no useful limit; naming a check that
/// was not made is a failure.
void judgeByUser(const std::vector<AcceptanceLimit>& acceptance, ValidationResult& result);

}  // namespace ursula
