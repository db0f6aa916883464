#pragma once

#include <filesystem>

#include "model/scenario.h"

namespace ursula {

/// readScenario(), or, where `file` is "-", from standard input, which errors call <stdin>: relative paths are then
/// taken from the current folder. Standard input can be read once.
Scenario readScenarioOrInput(const std::filesystem::path& file);

}  // namespace ursula
