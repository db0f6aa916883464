#pragma once

#include <cstddef>
#include <string_view>

#include "base/text_source.h"

namespace ursula {

/// Limits of a document. Real ones have at most six levels and some ten thousand waypoints.
constexpr std::size_t most_toml_bytes = std::size_t{32} << 20, most_toml_depth = 64, most_toml_keys = 200'000,
                      most_toml_values = 2'000'000;

/// Checks a document before it is parsed, because the parser recurses at each level. It counts nested brackets and
/// dots, keys and values. It refuses numbers that underflow or overflow a double. Throws TextRefusal. It does not
/// report invalid TOML.
void requireBounded(std::string_view document);

}  // namespace ursula
