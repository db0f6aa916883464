#pragma once

#include <string>

#include "exchange/recognise/imported_machine.h"

namespace ursula::exchange {

/// The machine as a scenario in TOML, each number the shortest that reads back as the same double, with comments that
/// say where the numbers are from. `file` is the model's name, for the comments.
std::string scenarioText(const ImportedMachine& machine, const std::string& file);

}  // namespace ursula::exchange
