#pragma once

#include <map>
#include <string>

#include "model/scenario.h"

namespace ursula {

/// Tolerances by the paths of numbers. A tolerance is the standard uncertainty of its number, in the number's unit; the
/// deviation is taken to be normal.
using NumberTolerances = std::map<std::string, double>;

/// Returns the tolerances that a scenario states for its machine, `mass = { value = 10.0, tolerance = 0.05 }`, by the
/// paths of machineNumbers(). A leg inherits the defaults' tolerances unless it overrides their keys. Empty for a
/// scenario that a program made.
NumberTolerances statedTolerances(const Scenario& scenario);

}  // namespace ursula
