#pragma once

#include <string>

#include "exchange/recognise/machine.h"

namespace ursula::exchange {

/// Returns the machine as a scenario in TOML, with comments on the origin of the numbers. Each number is the shortest
/// that parses to the same double. `file` is the model's name in the comments.
std::string scenarioText(const ImportedMachine& machine, const std::string& file);

/// "leg_1_d, leg_2_d, …": names in the file of the motors, in the order of the scenario's efforts.
std::string motorsOf(const ImportedMachine& machine);

}  // namespace ursula::exchange
