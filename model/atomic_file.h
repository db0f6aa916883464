#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ursula {

/// A file that is written piece by piece and seen by no reader before all of it is there: what is not committed leaves
/// nothing behind, however the program ends, where the file system can have files without a name. What is there and is
/// no file, a device or a named pipe, is written to as it is.
///
/// Makes missing parent folders. Throws std::filesystem::filesystem_error or std::runtime_error with the path.
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
  [[noreturn]] void fail() const;

  std::filesystem::path file_;
  std::filesystem::path temporary_;  ///< empty where the file has no name yet
  int descriptor_ = -1;
  bool in_place_ = false;
};

/// The whole of a file at once: no reader ever sees half of it. Throws as AtomicFile.
void writeFileAtomically(const std::filesystem::path& file, const std::string& content);

}  // namespace ursula
