#pragma once

#include <string>
#include <vector>

#include "model/mechanism_scenario.h"
#include "parts/simulate/simulate.h"

namespace ursula {

struct SimulateOptions {
  std::string scenario, torques, out = "-";
  std::vector<std::string> map;
  SimulationEngine engine = SimulationEngine::simbody;
  double time_limit = 0;  ///< s; 0 if not given
};

/// `ursula simulate` for a scenario with [mechanism]; without `torques` under the NOC's efforts along the motion.
int simulateMechanismVerb(const MechanismScenario& scenario, const SimulateOptions& options);

}  // namespace ursula
