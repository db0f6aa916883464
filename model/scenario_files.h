#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <vector>

#include "model/scenario.h"

namespace ursula {

/// Files that a scenario's document names, of samples for one, made absolute there: `scenario` is where it stands.
std::vector<std::filesystem::path> makeFilesAbsolute(toml::table& document, const std::filesystem::path& scenario);

/// The same of a scenario that was read; none of one that a program made.
std::vector<std::filesystem::path> filesNamedBy(const Scenario& scenario);

}  // namespace ursula
