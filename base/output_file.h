#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/fresh_paths.h"

namespace ursula {

/// A file written in pieces that readers see only once it is complete and on the disk. Until then it has a temporary
/// name in the same folder. An uncommitted file is removed. If the process was killed, the next file written there
/// removes it.
///
/// A replaced file keeps its mode and, if the system permits, its owner. A symbolic link stays; its target is replaced.
/// Only this name of several hard links gets the new file. Devices, named pipes and open files (/dev/stdout) are
/// written in place. Read-only files are refused.
///
/// Makes missing parent folders, and removes them if nothing is committed. Throws std::filesystem::filesystem_error
/// or std::runtime_error with the path.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view piece);
  /// Gives the file its name and replaces an older one. Nothing may be written afterwards.
  void commit();

 private:
  void openTemporary();

  std::filesystem::path file_;  ///< as the caller calls it
  std::filesystem::path end_;   ///< with its links resolved
  FreshPaths fresh_;
  std::filesystem::path temporary_;  ///< empty if the file is written in place
  int descriptor_ = -1;
};

/// Writes a whole file at once; no reader ever sees half of it. Throws like OutputFile.
void writeFileAtomically(const std::filesystem::path& file, const std::string& content);

/// Throws std::runtime_error, "cannot write FILE: WHY".
[[noreturn]] void refuseToWrite(const std::filesystem::path& file, const std::string& why);

/// Follows a chain of symbolic links to its end, which need not exist. A /proc link to an open file, like /dev/stdout,
/// is an end. Throws std::runtime_error for a circle.
std::filesystem::path endOfLinks(std::filesystem::path file);

/// Throws std::runtime_error, "cannot write FILE: WHY", if a file of that name cannot be written or replaced; makes
/// nothing. Reasons are a folder of that name, a read-only file, a name too long, a file in place of a folder, or a
/// folder without write permission. Root is refused a read-only file or folder, too.
void requireWritable(const std::filesystem::path& file);

/// Throws the same for files in a folder that may not exist yet; the message names `shown`.
void requireWritableFolder(const std::filesystem::path& folder, const std::filesystem::path& shown);

}  // namespace ursula
