#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"
#include "validation/external/external_samples.h"

namespace ursula {

/// What a person would say of torques that are wrong.
struct Diagnosis {
  std::string summary;    ///< which legs, when, by how much, in a line
  std::string deviation;  ///< the same for each leg
  std::string cause;      ///< a guess that the residual supports, or that there is none
};

/// Only for torques that are beyond their limits somewhere: of exact ones there is nothing to say, and all are empty.
Diagnosis diagnose(const Scenario& scenario, const ExternalTorques& torques);

}  // namespace ursula
