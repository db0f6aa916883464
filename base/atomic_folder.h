#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/carry_over.h"
#include "base/folder_lock.h"
#include "base/fresh_folders.h"

namespace ursula {

/// A folder whose files belong together: they are written beside it and take its place as a whole when they are
/// committed, on the disk; until then, and where that fails, what was there is as it was. What an older run did not
/// write is carried over, a user's notes for one. While this is there, no other process writes the same folder.
///
/// A folder that must stay the same to its users, a mount point or one that this process works in, or one that cannot
/// be swapped, has its files replaced one by one.
class AtomicFolder {
 public:
  /// Paths of what an older run wrote into a folder, relative to it: these are not carried over.
  using OlderFiles = std::function<Paths(const std::filesystem::path& folder)>;

  /// Makes missing parent folders, which go again if nothing is committed, and removes what dead processes left. Throws
  /// FolderInUse after some seconds, and std::runtime_error or std::filesystem::filesystem_error with the path.
  AtomicFolder(std::filesystem::path folder, OlderFiles older);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Throws std::runtime_error where a file of that name could not be written; writes nothing.
  void require(const std::filesystem::path& name) const;
  /// From any thread. Throws std::runtime_error with the path that the file will have.
  void write(const std::filesystem::path& name, const std::string& content);
  /// The same of what `fill` gives piece by piece.
  using Take = std::function<void(const std::string& piece)>;
  void write(const std::filesystem::path& name, const std::function<void(const Take&)>& fill);
  /// The last that is done; others may then write there. Throws std::runtime_error or
  /// std::filesystem::filesystem_error.
  void commit();

 private:
  std::string own(const std::string& kind) const;
  void sweep() const;
  void makeLikeOld() const;
  void swap();
  void replaceOneByOne();
  void makeFolder(const std::filesystem::path& folder);
  void removeMade() const;

  std::filesystem::path shown_;   ///< as the caller calls it
  std::filesystem::path folder_;  ///< without links
  std::filesystem::path base_;    ///< where its temporaries are: the folder above, or itself
  OlderFiles older_;
  FreshFolders parents_;
  std::vector<std::filesystem::path> made_;  ///< the temporary and what is written into it, the outermost first
  bool stays_ = false;                       ///< the same folder to its users
  std::optional<AtEnding> ending_;
  std::optional<FolderLock> lock_;
  std::mutex mutex_;  // guards what follows
  std::filesystem::path temporary_;
  std::vector<std::filesystem::path> written_;  ///< relative, in their order
};

}  // namespace ursula
