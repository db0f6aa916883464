#pragma once

#include <filesystem>
#include <string>

namespace ursula {

/// Writes `content` to `file` through a temporary name beside it and a rename, so that no reader ever sees half of it.
/// Makes missing parent folders. Throws std::filesystem::filesystem_error or std::runtime_error with the path.
void writeFileAtomically(const std::filesystem::path& file, const std::string& content);

}  // namespace ursula
