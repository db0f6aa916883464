#pragma once

#include <filesystem>

namespace ursula {

/// Where another file system, or another part of one, is mounted; false of what is not there.
bool isMountPoint(const std::filesystem::path& path);

/// Whether anything in `folder` is one, however deep, as far as it may be entered.
bool holdsMountPoint(const std::filesystem::path& folder);

}  // namespace ursula
