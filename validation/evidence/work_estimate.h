#pragma once

#include "model/scenario.h"

namespace ursula {

/// About how long validate() takes on this machine, s, from what a few evaluations take and how many there will be;
/// within a factor of three for the scenarios that ship.
double workSeconds(const Scenario& scenario);

}  // namespace ursula
