#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "base/fresh_paths.h"

namespace ursula {

using Paths = std::set<std::filesystem::path>;

/// A folder whose files belong together. They are written into a folder beside it, which replaces it as a whole on
/// commit. Until then, or on failure, the old folder stays as it was. Files that no older run wrote, such as a user's
/// notes, are carried over. No other process can write the folder meanwhile. Other runs may write in a folder below it;
/// the swap waits for them.
///
/// A folder is refused if a swap is impossible or harms its users. Such are mount points, folders that contain one, the
/// working folder of this process, and folders with unreadable content.
class OutputFolder {
 public:
  /// Returns the files that an older run wrote, relative to the folder; these are not carried over.
  using OlderFiles = std::function<Paths(const std::filesystem::path& folder)>;

  /// Makes missing parent folders, which are removed if nothing is committed; removes files of dead processes. Throws
  /// std::runtime_error or std::filesystem::filesystem_error with the path. It waits some seconds for another writer
  /// before it throws.
  explicit OutputFolder(std::filesystem::path folder, OlderFiles older = nullptr);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Throws std::runtime_error if a file of that name could not be written; writes nothing.
  void require(const std::filesystem::path& name) const;
  /// Any thread may call this. Throws std::runtime_error with the final path of the file.
  void write(const std::filesystem::path& name, const std::string& content);
  /// The same for content that `fill` gives in pieces.
  using Take = std::function<void(const std::string& piece)>;
  void write(const std::filesystem::path& name, const std::function<void(const Take&)>& fill);
  /// Replaces the folder and lets others write there; nothing may be written afterwards. Throws std::runtime_error or
  /// std::filesystem::filesystem_error.
  void commit();

 private:
  void requireSwappable() const;
  void lock();
  bool tryToLock();
  void sweep() const;
  void swap();
  std::string own(const std::string& kind) const;
  Paths olderIn(const std::filesystem::path& folder) const { return older_ ? older_(folder) : Paths(); }

  std::filesystem::path shown_;   ///< as the caller calls it
  std::filesystem::path folder_;  ///< without links
  std::filesystem::path above_;   ///< the folder of its lock and its temporaries
  std::filesystem::path lock_file_;
  OlderFiles older_;
  FreshPaths fresh_;
  int lock_ = -1;
  bool is_alone_ = false;  ///< false if the file system has no locks: other writers are then unknown
  std::mutex mutex_;       // guards what follows
  std::filesystem::path temporary_;
  Paths written_;                       ///< relative paths
  std::vector<HeldFolder> held_above_;  ///< folders above this one; no run swaps them while they are held
};

}  // namespace ursula
