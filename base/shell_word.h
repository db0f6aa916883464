#pragma once

#include <string>

namespace ursula {

/// Returns a file name as one shell word: quoted if needed, and never an option.
std::string shellWord(const std::string& file);

}  // namespace ursula
