#pragma once

#include <string>

#include "model/leg_kind.h"

namespace ursula {

/// apps/starting/KIND.toml, the text that `ursula init` writes.
std::string startingScenario(LegKind kind);

}  // namespace ursula
