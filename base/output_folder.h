#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <string>

#include "base/fresh_paths.h"

namespace ursula {

using Paths = std::set<std::filesystem::path>;

/// A folder whose files belong together: they are written beside it and take its place as a whole when they are
/// committed, on the disk; until then, and where that fails, what was there is as it was. What an older run did not
/// write is carried over, a user's notes for one. While this is there, no other process writes the same folder.
///
/// Refused is a folder that cannot be swapped, or whose swap would take it from its users: a mount point or one that
/// holds one, one that this process works in, one with something in it that may not be read.
class OutputFolder {
 public:
  /// Paths of what an older run wrote into a folder, relative to it: these are not carried over.
  using OlderFiles = std::function<Paths(const std::filesystem::path& folder)>;

  /// Makes missing parent folders, which go again if nothing is committed, and removes what dead processes left. Throws
  /// std::runtime_error or std::filesystem::filesystem_error with the path; after some seconds, where another writes
  /// there.
  explicit OutputFolder(std::filesystem::path folder, OlderFiles older = nullptr);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

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
  void requireSwappable() const;
  void lock();
  bool tryToLock();
  void sweep() const;
  void swap();
  std::string own(const std::string& kind) const;
  Paths olderIn(const std::filesystem::path& folder) const { return older_ ? older_(folder) : Paths(); }

  std::filesystem::path shown_;   ///< as the caller calls it
  std::filesystem::path folder_;  ///< without links
  std::filesystem::path above_;   ///< where its lock and its temporaries are
  std::filesystem::path lock_file_;
  OlderFiles older_;
  FreshPaths fresh_;
  int lock_ = -1;
  bool is_alone_ = false;  ///< not where the file system has no locks: then nobody knows who else is there
  std::mutex mutex_;       // guards what follows
  std::filesystem::path temporary_;
  Paths written_;  ///< relative
};

}  // namespace ursula
