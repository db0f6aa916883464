#pragma once

#include <filesystem>
#include <string>

namespace ursula {

/// Reads the text of a scenario of either machine, `-` for standard input. Throws ScenarioError, for a model (XML) with
/// the command that makes a scenario of it.
std::string scenarioNotModel(const std::filesystem::path& file);

}  // namespace ursula
