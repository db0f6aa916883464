#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "model/scenario.h"

namespace ursula {

/// A scenario as text, and what that text states.
struct WrittenScenario {
  std::string text;
  Scenario states;          ///< every number is the one in the text
  bool in_degrees = false;  ///< orientations in degrees, so that those of `states` are off by a rounding
};

/// Writes a scenario that a program made. This knows the keys by docs/scenario.md and shares nothing with the reader,
/// so both together show what the reader gets wrong. `seed` chooses among all ways to write it: defaults and own keys,
/// friction by joint or coordinate, degrees or radians, tables in the file or in a CSV in `folder`. A helix is replaced
/// by a random one, because a trajectory does not give its parameters.
WrittenScenario asText(const Scenario& scenario, std::uint64_t seed, const std::filesystem::path& folder);

}  // namespace ursula
