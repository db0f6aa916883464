#pragma once

#include <cstdint>
#include <vector>

#include "parts/random/random_scenario.h"

namespace ursula {

constexpr int scenarios_drawn = 300;

/// The random scenarios of the seeds from 1 on, drawn once.
inline const std::vector<Scenario>& drawnScenarios() {
  static const std::vector<Scenario> scenarios = [] {
    std::vector<Scenario> out;
    for (std::uint64_t seed = 1; seed <= scenarios_drawn; ++seed) out.push_back(randomScenario(seed));
    return out;
  }();
  return scenarios;
}

}  // namespace ursula
