#pragma once

#include <filesystem>
#include <set>

namespace ursula {

using Paths = std::set<std::filesystem::path>;

/// Links everything of the folder `old` into `fresh` that is neither in `leave` nor there already, with all that is in
/// its folders, so that it is in both; copies it where the file system has no links. Paths are relative to either
/// folder. Throws std::runtime_error where one has a folder and the other a file of a name, and what copying throws.
void carryOver(const std::filesystem::path& old, const std::filesystem::path& fresh, const Paths& leave);

/// Moves what came into `old` after it was carried over, or changed there, to `fresh`, which has the files `written`
/// of its own; then removes `old`, unless something is mounted in it.
void bringAfter(const std::filesystem::path& old, const std::filesystem::path& fresh, const Paths& leave,
                const Paths& written);

}  // namespace ursula
