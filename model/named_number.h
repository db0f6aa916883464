#pragma once

#include <string>

#include "model/manipulator.h"

namespace ursula {

/// A number of the machine by its name as EffortDerivatives gives it: "leg[2].distal.inertia.xy". Throws
/// std::out_of_range for another.
double valueOfNumber(const ManipulatorParameters& machine, const std::string& name);

/// Adds to it; an inertia's xy is yx as well.
void changeNumber(ManipulatorParameters& machine, const std::string& name, double by);

}  // namespace ursula
