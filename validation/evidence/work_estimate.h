#pragma once

#include "model/scenario.h"

namespace ursula {

/// Relative work of a validation's parts, in evaluations of the closed loop's derivatives.
struct WorkParts {
  double reference = 0, samples = 0, replays = 0, checks = 0, sources = 0;  ///< in their order
  double total() const { return reference + samples + replays + checks + sources; }
};

/// By numbers of steps and samples, as measured on the shipped scenarios with up to 100,000 samples.
WorkParts workParts(const Scenario& scenario);

/// Estimates the time of validate() on this machine, s, from a few evaluations and their expected number. It is within
/// a factor of three for the shipped scenarios.
double workSeconds(const Scenario& scenario);

}  // namespace ursula
