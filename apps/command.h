#pragma once

#include <string>
#include <vector>

namespace ursula {

/// Runs a command without a shell and returns its standard output; the user sees its standard error. Throws
/// std::runtime_error if there is no such command, or if it fails.
std::string outputOf(const std::vector<std::string>& words);

}  // namespace ursula
