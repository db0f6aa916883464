#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Applies the scenario's own limits, each to the largest value of its check, and sets the verdict. A user's limit
/// decides an unjudged check only if that check lacked a useful limit. A limit for a check that was not made is a
/// failure.
void judgeByUser(const std::vector<AcceptanceLimit>& acceptance, ValidationResult& result);

/// Applies a user's limit to one check; `whose` names its basis. For an unfinished check only the words change.
void judgeByUser(double limit, const std::string& whose, Check& check);

}  // namespace ursula
