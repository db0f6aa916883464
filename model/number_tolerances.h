#pragma once

#include <map>
#include <string>

#include "model/scenario.h"

namespace ursula {

/// Tolerances by the paths of numbers. One is the standard uncertainty of its number, in the number's own unit: what it
/// is off by is taken to be normal with that deviation.
using NumberTolerances = std::map<std::string, double>;

/// Those that a scenario states of its machine, `mass = { value = 10.0, tolerance = 0.05 }`, by the paths of
/// machineNumbers(). A leg has those of the defaults whose keys it does not override. Empty for a scenario that a
/// program made.
NumberTolerances statedTolerances(const Scenario& scenario);

}  // namespace ursula
