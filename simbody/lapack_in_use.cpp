#include "simbody/lapack_in_use.h"

#include <dlfcn.h>

#include <filesystem>

namespace ursula {

std::string lapackInUse() {
  std::string files;
  for (const char* function : {"dgetrf_", "dgemm_"}) {
    Dl_info where{};
    const void* at = ::dlsym(RTLD_DEFAULT, function);
    if (at == nullptr || ::dladdr(at, &where) == 0) return "unknown";
    std::error_code failed;
    const std::filesystem::path file = std::filesystem::canonical(where.dli_fname, failed);
    if (failed) return "unknown";
    files += (files.empty() ? "" : ", ") + (file.parent_path().filename() / file.filename()).string();
  }
  return files;
}

}  // namespace ursula
