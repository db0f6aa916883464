#pragma once

#include <filesystem>
#include <string>

#include "model/scenario.h"

namespace ursula {

/// The document of a scenario that was read, as JSON: the same keys and values, with every file that it names made
/// absolute. Throws ScenarioError for one that a program made, since its text says nothing of it.
std::string scenarioJson(const Scenario& scenario);

/// The same document in TOML, for parseScenario(). `file` names it in errors. Throws ScenarioError for what is no JSON
/// object, and for null, which TOML has not, with its key.
std::string tomlOfJson(const std::string& json, const std::filesystem::path& file);

}  // namespace ursula
