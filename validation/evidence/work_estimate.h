#pragma once

#include "model/scenario.h"

namespace ursula {

/// How much work the parts of a validation are to each other, in evaluations of the closed loop's derivatives.
struct WorkParts {
  double reference = 0, samples = 0, replays = 0, checks = 0, sources = 0;  ///< in their order
  double total() const { return reference + samples + replays + checks + sources; }
};

/// By their number of steps and of samples; as measured on the scenarios that ship, with up to 100,000 samples.
WorkParts workParts(const Scenario& scenario);

/// About how long validate() takes on this machine, s, from what a few evaluations take and how many there will be;
/// within a factor of three for the scenarios that ship.
double workSeconds(const Scenario& scenario);

}  // namespace ursula
