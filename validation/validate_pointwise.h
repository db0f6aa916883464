#pragma once

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// The part of validate() that needs no replay and little of Simbody: the commanded motion, and joint motion and
/// torques of the NOC and Simbody at the scenario's instants. Values are those of validate(); limits are derived
/// instead of measured, and so wider. If a value exceeds one, it makes all of validate()'s pointwise checks with their
/// limits. `of_motion` are earlier checks of the commanded motion; null makes them here. Throws like validate().
ValidationResult validatePointwise(const Scenario& scenario, const std::vector<Check>* of_motion = nullptr);

}  // namespace ursula
