#pragma once

#include <string>

#include "exchange/recognise/imported_machine.h"

namespace ursula::exchange {

/// Returns the machine as a scenario in TOML, with comments on the origin of the numbers. Each number is the shortest
/// that parses to the same double. `file` is the model's name in the comments.
std::string scenarioText(const ImportedMachine& machine, const std::string& file);

}  // namespace ursula::exchange
