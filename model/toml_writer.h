#pragma once

#include <toml++/toml.h>

#include <string>

namespace ursula {

/// A document as text that reads as the same values. Numbers are the shortest that do so; keys stand in alphabetical
/// order.
std::string tomlText(const toml::table& document);

}  // namespace ursula
