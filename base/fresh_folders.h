#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace ursula {

/// Folders that are made for something that may come to nothing: those that are empty go again, unless they are kept.
class FreshFolders {
 public:
  FreshFolders() = default;
  explicit FreshFolders(const std::filesystem::path& folder) { make(folder); }
  ~FreshFolders() {
    if (!kept_) remove();
  }
  FreshFolders(const FreshFolders&) = delete;
  FreshFolders& operator=(const FreshFolders&) = delete;

  /// Makes `folder` and those above it that are missing. Throws std::filesystem::filesystem_error.
  void make(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> missing;
    for (std::filesystem::path each = folder; !each.empty() && !std::filesystem::is_directory(each);
         each = each.parent_path())
      missing.push_back(each);
    std::reverse(missing.begin(), missing.end());
    for (const std::filesystem::path& each : missing)
      if (std::filesystem::create_directory(each)) made_.push_back(each);
  }

  void keep() { kept_ = true; }

  /// May be called within a signal's handler.
  void remove() const {
    for (auto made = made_.rbegin(); made != made_.rend(); ++made) ::rmdir(made->c_str());
  }

 private:
  std::vector<std::filesystem::path> made_;  ///< the outermost first
  bool kept_ = false;
};

}  // namespace ursula
