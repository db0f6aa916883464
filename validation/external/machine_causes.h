#pragma once

#include <vector>

#include "validation/external/cause.h"

namespace ursula {

/// Every continuous parameter of the machine, for all legs, both links or one leg; gravity's size; the other knee
/// branch on any legs; inertias about the wrong point; mass centres from the wrong end; exchanged values. Likely causes
/// come first.
std::vector<Cause> machineCauses(const Scenario& scenario);

}  // namespace ursula
