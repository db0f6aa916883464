#pragma once

#include <filesystem>

namespace ursula {

/// Where a chain of symbolic links ends, whether something is there or not; a link of /proc, which stands for what a
/// process has open, as /dev/stdout does, is an end. Throws std::runtime_error for a circle.
std::filesystem::path endOfLinks(std::filesystem::path file);

/// Of such an end: a device, a pipe, what a process has open. To put a file in its place would take it from all who use
/// it.
bool isWrittenThrough(const std::filesystem::path& end);

/// Makes nothing. Throws std::runtime_error, "cannot write FILE: why", where a file of that name could not be written
/// or replaced: a folder is there, a file that nobody may write to, a name is too long, a file stands where a folder
/// should, or the folder is not to be written into. What is read-only is so for root, too.
void requireWritable(const std::filesystem::path& file);

/// The same of a folder, there or not, for files to be made in it.
void requireWritableFolder(const std::filesystem::path& folder);

}  // namespace ursula
