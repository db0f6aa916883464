#pragma once

#include <string>

namespace ursula {

/// One word for a shell, whatever is in it: quoted where it has to be, and never an option, as it is the name of a
/// file.
std::string shellWord(const std::string& file);

}  // namespace ursula
