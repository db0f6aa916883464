#pragma once

#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// What of validate() needs no replay and little of Simbody: the commanded motion, and the NOC's joint motion and
/// torques against Simbody's at the scenario's instants. Values are those of validate(); limits are derived and not
/// measured, and so wider. Where a value is beyond one, all of validate()'s pointwise checks are made, with its limits.
/// `of_motion`: the checks of the commanded motion where they were made before; null: made here. Throws as validate().
ValidationResult validatePointwise(const Scenario& scenario, const std::vector<Check>* of_motion = nullptr);

}  // namespace ursula
