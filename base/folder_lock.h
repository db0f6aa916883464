#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "base/at_ending.h"

namespace ursula {

/// Another process holds the lock.
struct FolderInUse : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A lock by the name of a file, held until this goes or the process ends, however it ends; the file goes, too, but
/// where the process is killed. It
/// keeps other processes and threads away that ask for it by the same name, where the file system has locks.
class FolderLock {
 public:
  /// Waits some seconds for another to end. Throws FolderInUse, which speaks of `what`, and std::runtime_error.
  FolderLock(std::filesystem::path file, const std::filesystem::path& what);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// False where the file system has no locks: then nobody knows who else is there.
  bool isExclusive() const { return is_exclusive_; }

 private:
  bool take(const std::filesystem::path& what);
  std::string holder() const;
  static void remove(const void* lock);

  std::filesystem::path file_;
  int descriptor_ = -1;
  bool is_exclusive_ = false;
  std::optional<AtEnding> ending_;
};

}  // namespace ursula
