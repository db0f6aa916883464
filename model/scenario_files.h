#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// Makes the paths in a scenario's document absolute, such as that of samples, and returns them. `scenario` is its
/// file.
std::vector<std::filesystem::path> makeFilesAbsolute(toml::table& document, const std::filesystem::path& scenario);

/// Returns the same paths of a scenario that was read; none if a program made it.
std::vector<std::filesystem::path> filesNamedBy(const Scenario& scenario);

}  // namespace ursula
