#pragma once

#include <vector>

#include "validation/external/cause.h"

namespace ursula {

/// Every continuous parameter of the machine: for all legs at once, for both links, for one leg; gravity's size; the
/// other knee on any legs; inertias about the wrong point, mass centres from the wrong end, what was exchanged. Likely
/// ones first.
std::vector<Cause> machineCauses(const Scenario& scenario);

}  // namespace ursula
