#pragma once

#include <cstddef>
#include <string_view>

#include "base/text_source.h"

namespace ursula {

/// What a document may hold. The deepest of ours has six levels, the longest some ten thousand waypoints.
constexpr std::size_t most_toml_bytes = std::size_t{32} << 20, most_toml_depth = 64, most_toml_keys = 200'000,
                      most_toml_values = 2'000'000;

/// Looks over a document before it is parsed, since the parser calls itself for each level: brackets and dots of a key
/// within each other, keys and values are counted, and numbers are refused that a double can only hold as zero or
/// infinity. Throws TextRefusal. Of what is no TOML it says nothing.
void requireBounded(std::string_view document);

}  // namespace ursula
