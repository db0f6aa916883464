#pragma once

#include <filesystem>
#include <string>

namespace ursula {

/// `.ursula-KIND-PROCESS-N` in `folder`: a short name, so that none is too long for what it is to become. Unique among
/// processes by the process id, and among threads of this one by a count.
std::filesystem::path temporaryIn(const std::filesystem::path& folder, const std::string& kind);

/// Takes a lock of the open file or folder, which ends with the last descriptor of this opening: that of a process that
/// is dead is free. `free` where the lock was taken, `taken` where another holds it, `unknown` where the file system
/// has none.
enum class Lock { free, taken, unknown };
Lock tryLock(int descriptor);

/// Whether `name` still is what `descriptor` has open.
bool isStill(int descriptor, const std::filesystem::path& name);

/// Removes files that temporaryIn named of this kind and whose process, which held a lock on them, is gone.
void sweepTemporaries(const std::filesystem::path& folder, const std::string& kind);

}  // namespace ursula
