#pragma once

#include <string>

#include "model/scenario.h"

namespace ursula {

/// The paper's helix, scenarios/paper-helix.toml as it was when this program was built.
Scenario paperHelix();

/// scenarios/proving-ground.toml as built in: what `ursula prove` injects defects into.
Scenario provingGround();

/// apps/starting/KIND.toml, the text that `ursula init` writes.
std::string startingScenario(LegKind kind);

}  // namespace ursula
