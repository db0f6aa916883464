#pragma once

#include <string>
#include <vector>

namespace ursula {

/// Runs a command, no shell between, and returns what it prints; what it says on standard error, the user sees. Throws
/// std::runtime_error where there is no such command, or it fails.
std::string outputOf(const std::vector<std::string>& words);

}  // namespace ursula
