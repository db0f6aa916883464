#pragma once

#include <filesystem>

#include "model/scenario.h"

namespace ursula {

/// The text of a scenario that a program put together, spelt in as many ways as there are, by `seed`: defaults and own
/// keys, friction by joint or coordinate, degrees or radians, tables in the file or in a CSV, written to `folder`. A
/// helix is another one, drawn by the seed, for a trajectory does not tell its parameters.
std::string asText(const Scenario& scenario, std::uint64_t seed, const std::filesystem::path& folder);

}  // namespace ursula
