#pragma once

#include <filesystem>
#include <vector>

namespace ursula {

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
