#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/output_folder.h"
#include "tests/base/temporary_folder.h"

namespace ursula {

/// The paths that an older run wrote, with the folder of one of its scenarios.
inline Paths older(const std::filesystem::path&) { return {"a", "b", "gone", "gone/a"}; }

/// Every file's content by its path; paths of folders end in a slash.
inline std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    all[entry.is_directory() ? name + "/" : name] = entry.is_directory() ? "" : TemporaryFolder::read(entry.path());
  }
  return all;
}

inline void writeRun(const std::filesystem::path& folder, const std::string& text) {
  OutputFolder out(folder, older);
  out.write("a", text);
  out.write("sub/a", text);
  out.commit();
}

}  // namespace ursula
