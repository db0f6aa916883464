#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/mechanism.h"

namespace ursula {

/// The mistakes that a scenario of one machine or the other cannot show; nullopt if this build knows none. Throws
/// ScenarioError.
std::optional<std::vector<BlindSpot>> blindSpotsOf(const Scenario* manipulator, const MechanismScenario* mechanism);
inline std::optional<std::vector<BlindSpot>> blindSpotsOf(const AnyScenario& scenario) {
  return blindSpotsOf(scenario.manipulator ? &*scenario.manipulator : nullptr,
                      scenario.mechanism ? &*scenario.mechanism : nullptr);
}

/// Throws UsageError if this build knows no mistakes, or if a file of that name exists.
void requireSuggestion(const std::string& out);

/// Writes the scenario with a motion under which more mistakes show than with its own, and says which then do not.
/// `out` is a new file, or standard output if empty or "-". Throws ScenarioError if the machine cannot make such a
/// motion.
void suggestMotion(const AnyScenario& scenario, const std::vector<BlindSpot>& blind, const std::string& out);

}  // namespace ursula
