#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// Makes the paths in a scenario's document absolute, such as that of samples or of a model, and returns them.
/// `scenario` is its file.
std::vector<std::filesystem::path> makeFilesAbsolute(toml::table& document, const std::filesystem::path& scenario);

/// Returns the same paths of a scenario's text, of either machine.
std::vector<std::filesystem::path> filesNamedBy(const std::string& text, const std::filesystem::path& file);
/// Returns the same paths of a scenario that was read; none if a program made it.
std::vector<std::filesystem::path> filesNamedBy(const Scenario& scenario);

/// Returns "FILE: read as: …" for each such file whose columns are not named as in the contract.
std::vector<std::string> readAs(const Scenario& scenario);

/// Reads the text of a scenario file. Throws ScenarioError if it cannot be read.
std::string scenarioText(const std::filesystem::path& file);

/// Returns the file's name in errors: <stdin> for "-".
std::filesystem::path namedInput(const std::filesystem::path& file);

/// Reads the text of a scenario file, or standard input if `file` is "-", which can be read once.
std::string scenarioTextOrInput(const std::filesystem::path& file);

/// The place of a key in a scenario's file.
struct KeyPlace {
  std::string place;             ///< `file:line:column` of its value, or of the nearest enclosing table
  std::string key;               ///< dotted; begins with manipulator.leg_defaults if a leg inherits it
  bool given = false;            ///< whether the leg itself or the defaults give it
  std::optional<double> number;  ///< its value as written, if that is a number
};

/// Finds a dotted key (`manipulator.leg[2].proximal.mass`, legs 1-based) in a scenario that was read. If a program made
/// the scenario, the place is its file's first line.
KeyPlace placeInFile(const Scenario& scenario, const std::string& key);

}  // namespace ursula
