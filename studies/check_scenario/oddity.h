#pragma once

#include <string>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// A value that a machine or motion may have, but rarely has.
struct Oddity {
  std::string key;   ///< dotted, of the scenario: `manipulator.leg[2].proximal.mass`
  std::string what;  ///< the number, the usual value, and the probable intention
};

std::vector<Oddity> oddMachine(const Scenario& scenario);
std::vector<Oddity> oddMotion(const Scenario& scenario);

}  // namespace ursula
