#pragma once

#include <filesystem>

#include "model/scenario.h"

namespace ursula {

/// Returns the text of a scenario that a program made. `seed` chooses among all ways to write it: defaults and own
/// keys, friction by joint or coordinate, degrees or radians, tables in the file or in a CSV in `folder`. A helix is
/// replaced by a random one, because a trajectory does not give its parameters.
std::string asText(const Scenario& scenario, std::uint64_t seed, const std::filesystem::path& folder);

}  // namespace ursula
