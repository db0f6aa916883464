#include "apps/verbs.h"

#include <cstdio>
#include <filesystem>

#include "model/atomic_file.h"

namespace ursula {

void writeOutput(const std::string& file, const std::string& content) {
  if (!file.empty() && file != "-") {
    writeFileAtomically(file, content);
    return;
  }
  if (std::fwrite(content.data(), 1, content.size(), stdout) != content.size() || std::fflush(stdout) != 0)
    throw std::runtime_error("standard output could not be written");
}

void refuseFile(const std::string& out) {
  if (std::filesystem::exists(out) && !std::filesystem::is_directory(out))
    throw UsageError("--out " + out + ": is a file, expected a folder");
}

}  // namespace ursula
