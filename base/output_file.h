#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/fresh_paths.h"

namespace ursula {

/// A file that is written piece by piece and seen by no reader before all of it is there, and is on the disk: it has a
/// temporary name beside its own until then. What is not committed goes; of a process that is killed, with the next
/// file that is written there.
///
/// What is there keeps its mode and, where the system lets it, its owner; a symbolic link stays and what it points at
/// is replaced; of hard links one name gets the new file and the others keep the old. A device, a named pipe or what a
/// process has open (/dev/stdout) is written to as it is. What is read-only is refused.
///
/// Makes missing parent folders, which go again where it is not committed. Throws std::filesystem::filesystem_error or
/// std::runtime_error with the path.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view piece);
  /// Gives it its name, in place of what had that name before. Nothing is written afterwards.
  void commit();

 private:
  void openTemporary();

  std::filesystem::path file_;  ///< as the caller calls it
  std::filesystem::path end_;   ///< what its links lead to
  FreshPaths fresh_;
  std::filesystem::path temporary_;  ///< empty where it is written in place
  int descriptor_ = -1;
};

/// The whole of a file at once: no reader ever sees half of it. Throws as OutputFile.
void writeFileAtomically(const std::filesystem::path& file, const std::string& content);

/// Throws std::runtime_error, "cannot write FILE: WHY".
[[noreturn]] void refuseToWrite(const std::filesystem::path& file, const std::string& why);

/// Where a chain of symbolic links ends, whether something is there or not; a link of /proc, which stands for what a
/// process has open, as /dev/stdout does, is an end. Throws std::runtime_error for a circle.
std::filesystem::path endOfLinks(std::filesystem::path file);

/// Makes nothing. Throws std::runtime_error, "cannot write FILE: why", where a file of that name could not be written
/// or replaced: a folder is there, a file that nobody may write to, a name is too long, a file stands where a folder
/// should, or the folder is not to be written into. What is read-only is so for root, too.
void requireWritable(const std::filesystem::path& file);

/// The same of a folder, there or not, for files to be made in it; the words are of `shown`.
void requireWritableFolder(const std::filesystem::path& folder, const std::filesystem::path& shown);

}  // namespace ursula
