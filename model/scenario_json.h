#pragma once

#include <filesystem>
#include <string>

#include "model/scenario.h"

namespace ursula {

/// Returns a scenario's document as JSON: the same keys and values, with absolute file paths. Throws ScenarioError if a
/// program made the scenario, because its text does not describe it.
std::string scenarioJson(const Scenario& scenario);

/// Returns the same of a scenario's text, of either machine; `file` anchors relative paths and names it in errors.
std::string scenarioJson(const std::string& text, const std::filesystem::path& file);

/// Returns the same document in TOML, for parseScenario(); `file` names it in errors. Throws ScenarioError if the text
/// is no JSON object, or if a value is null, which TOML lacks.
std::string tomlOfJson(const std::string& json, const std::filesystem::path& file);

}  // namespace ursula
