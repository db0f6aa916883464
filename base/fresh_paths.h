#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/at_ending.h"

namespace ursula {

/// Files and folders that are made for something that may come to nothing: they go again, a folder where it is empty,
/// with this, or with a signal that ends the process, unless they are kept.
class FreshPaths {
 public:
  FreshPaths();
  explicit FreshPaths(const std::filesystem::path& folder) : FreshPaths() { makeFolder(folder); }
  ~FreshPaths() { remove(); }
  FreshPaths(const FreshPaths&) = delete;
  FreshPaths& operator=(const FreshPaths&) = delete;

  /// Makes `folder` and those above it that are missing. Throws std::filesystem::filesystem_error.
  void makeFolder(const std::filesystem::path& folder);
  /// A new file, open to be written; −1 where there is one or the system refuses, errno says why.
  int makeFile(const std::filesystem::path& file);
  void add(const std::filesystem::path& path);
  void keep();
  void remove();

 private:
  void unlinkAll() const;

  std::vector<std::filesystem::path> made_;  ///< the outermost first
  AtEnding ending_;
};

/// `.ursula-KIND-PROCESS-N` in `folder`: a short name, so that none is too long for what it is to become. Unique among
/// processes by the process id, and among threads of this one by a count.
std::filesystem::path temporaryIn(const std::filesystem::path& folder, const std::string& kind);

/// Takes a lock of an open file, which ends with the last descriptor of this opening: that of a process that is dead is
/// free. `free` where the lock was taken, `taken` where another holds it, `unknown` where the file system has none.
enum class Lock { free, taken, unknown };
Lock tryLock(int descriptor);

/// Whether `name` still is what `descriptor` has open.
bool isStill(int descriptor, const std::filesystem::path& name);

/// All of `content` to an open file; false where the system refuses, errno says why.
bool writeAll(int descriptor, std::string_view content);

/// What was made, replaced or removed in it is so after a loss of power, too. Best effort: not every file system can.
void syncFolder(const std::filesystem::path& folder);

}  // namespace ursula
