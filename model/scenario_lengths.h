#pragma once

#include <filesystem>
#include <string>

namespace ursula {

/// Returns the text of a scenario file whose lengths are given in another unit, with its lengths in metres. `per_metre`
/// is 1000 for mm. Lengths are points, positions, link lengths, mass centres, and the helix's radius and pitch. All
/// else stays, comments and inertias too, and so do the numbers in files that the scenario names. Throws ScenarioError
/// for a file that cannot be read or is not TOML.
std::string withLengthsInMetres(int per_metre, const std::filesystem::path& file);

}  // namespace ursula
