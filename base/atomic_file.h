#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/fresh_folders.h"

namespace ursula {

/// A file that is written piece by piece and seen by no reader before all of it is there, and is on the disk: what is
/// not committed leaves nothing behind, however the program ends, where the file system can have files without a name.
///
/// What is there keeps its mode and, where the system lets it, its owner; a symbolic link stays and what it points at
/// is replaced; of hard links one name gets the new file and the others keep the old. A device, a named pipe or what a
/// process has open (/dev/stdout) is written to as it is. What is read-only is refused.
///
/// Makes missing parent folders, which go again where it is not committed. Throws std::filesystem::filesystem_error or
/// std::runtime_error with the path.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view piece);
  /// Gives it its name, in place of what had that name before. Nothing is written afterwards.
  void commit();

 private:
  void open();
  void openNamed();
  void takeName();
  void keepModeAndOwner() const;
  std::filesystem::path folder() const;
  [[noreturn]] void fail() const;

  std::filesystem::path file_;       ///< as the caller calls it
  std::filesystem::path end_;        ///< what its links lead to
  std::filesystem::path temporary_;  ///< empty where the file has no name yet
  FreshFolders parents_;
  int descriptor_ = -1;
  bool in_place_ = false;
};

/// The whole of a file at once: no reader ever sees half of it. Throws as AtomicFile.
void writeFileAtomically(const std::filesystem::path& file, const std::string& content);

/// All of `content` to an open file; false where the system refuses, errno says why.
bool writeAll(int descriptor, std::string_view content);

/// What was made, replaced or removed in it is so after a loss of power, too. Best effort: not every file system can.
void syncFolder(const std::filesystem::path& folder);

}  // namespace ursula
