#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Judges by the scenario's own limits where it has any, each held against the largest value of its check, and sets the
/// verdict. Of what could not be judged a limit of the user's lifts only what had no useful limit; naming a check that
/// was not made is a failure.
void judgeByUser(const std::vector<AcceptanceLimit>& acceptance, ValidationResult& result);

/// One check by a limit of the user's; `whose` is its basis, in words. Of an unfinished one only the words change.
void judgeByUser(double limit, const std::string& whose, Check& check);

}  // namespace ursula
