#pragma once

#include <string>

#include "model/mechanism_scenario.h"
#include "model/scenario.h"

namespace ursula {

/// Returns a page that needs no network, with the machine to move and its commanded path. Throws PoseError or LoopError
/// if the motion is impossible.
std::string viewHtml(const Scenario& scenario);
std::string viewHtml(const MechanismScenario& scenario);

}  // namespace ursula
