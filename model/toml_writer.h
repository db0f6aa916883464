#pragma once

#include <toml++/toml.h>

#include <string>

namespace ursula {

/// Writes a document as text that parses to the same values. Numbers are as short as possible; keys are in alphabetical
/// order.
std::string tomlText(const toml::table& document);

}  // namespace ursula
