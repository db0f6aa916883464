#pragma once

#include <vector>

#include "model/mechanism_scenario.h"
#include "model/scenario.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Returns the mistakes that machine and motion would let pass: each puts its change into the closed form, and no
/// effort then changes by more than the limit of the verdict. Those of all legs alike are one. Throws PoseError or
/// LoopError if the motion is impossible.
struct BlindSpotFinder {
  std::vector<BlindSpot> (*manipulator)(const Scenario& scenario);
  std::vector<BlindSpot> (*mechanism)(const MechanismScenario& scenario);
};

/// Null if no part of this build knows mistakes. CMake writes the definition (cmake/parts.cmake), once for each
/// program.
const BlindSpotFinder* partBlindSpots();

}  // namespace ursula
