#pragma once

#include <vector>

#include "validation/external/cause.h"

namespace ursula {

/// Errors in every continuous parameter of the machine, for all legs, both links or one leg. Others are gravity's size,
/// the other knee branch, inertias about the wrong point, mass centres from the wrong end, and exchanged values. Likely
/// causes come first.
std::vector<Cause> machineCauses(const Scenario& scenario);

}  // namespace ursula
