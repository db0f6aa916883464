#pragma once

#include <filesystem>

#include "model/scenario.h"

namespace ursula {

/// Calls readScenario(), or reads standard input, <stdin> in errors, if `file` is "-". Relative paths then refer to the
/// current folder. Standard input can be read once.
Scenario readScenarioOrInput(const std::filesystem::path& file);

}  // namespace ursula
