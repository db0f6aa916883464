#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/signal_cleanup.h"

namespace ursula {

/// New files and folders of work that may fail. The destructor, or a signal that ends the process, removes them unless
/// they are kept. Folders are removed only when empty.
class FreshPaths {
 public:
  FreshPaths();
  explicit FreshPaths(const std::filesystem::path& folder) : FreshPaths() { makeFolder(folder); }
  ~FreshPaths() { remove(); }
  FreshPaths(const FreshPaths&) = delete;
  FreshPaths& operator=(const FreshPaths&) = delete;

  /// Makes `folder` and its missing parents. Throws std::filesystem::filesystem_error.
  void makeFolder(const std::filesystem::path& folder);
  /// Opens a new file for writing. Returns −1 and sets errno if it exists or the system refuses.
  int makeFile(const std::filesystem::path& file);
  void add(const std::filesystem::path& path);
  void keep();
  void remove();

 private:
  void unlinkAll() const;

  std::vector<std::filesystem::path> made_;  ///< outermost first
  CleanupOnSignal ending_;
};

/// Returns `.ursula-KIND-PROCESS-N` in `folder`. The name is short, so it never exceeds the system's limit. The process
/// id and a count of this process make it unique.
std::filesystem::path temporaryIn(const std::filesystem::path& folder, const std::string& kind);

/// Takes a lock on an open file. The lock ends with the last descriptor of this opening, so a dead process holds none.
/// Returns `free` if the lock was taken, `taken` if another holds it, `unknown` if the file system has no locks.
enum class Lock { free, taken, unknown };
Lock tryLock(int descriptor);

/// Returns whether `name` still is the file that `descriptor` has open.
bool isStill(int descriptor, const std::filesystem::path& name);

/// Writes all of `content` to an open file. Returns false and sets errno if the system refuses.
bool writeAll(int descriptor, std::string_view content);

/// Makes changes in a folder survive a loss of power, if the file system can.
void syncFolder(const std::filesystem::path& folder);

/// Locks a folder: with others while files are written in it, alone while it is listed or swapped. Processes wait for
/// each other some seconds. Holds nothing where a folder cannot be locked, as on some network file systems.
class HeldFolder {
 public:
  enum class Kind { with_others, alone };

  HeldFolder(const std::filesystem::path& folder, Kind kind);
  ~HeldFolder();
  HeldFolder(HeldFolder&& from) noexcept;
  HeldFolder& operator=(HeldFolder&&) = delete;

 private:
  int descriptor_ = -1;
};

/// Holds a folder and all above it, with others, because another run may swap any of them.
std::vector<HeldFolder> heldWithFoldersAbove(const std::filesystem::path& folder);

}  // namespace ursula
