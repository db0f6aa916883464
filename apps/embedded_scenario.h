#pragma once

#include <string>

#include "model/scenario.h"

namespace ursula {

/// The paper's helix: scenarios/paper-helix.toml at the time of the build.
Scenario paperHelix();

/// The built-in scenarios/proving-ground.toml, into which `ursula prove` injects defects.
Scenario provingGround();

/// apps/starting/KIND.toml, the text that `ursula init` writes.
std::string startingScenario(LegKind kind);

}  // namespace ursula
