#include "base/held_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

#include "base/fresh_paths.h"

namespace ursula {

/// If the folder was swapped meanwhile, the new one is opened.
HeldFolder::HeldFolder(const std::filesystem::path& folder, Kind kind) {
  constexpr std::chrono::seconds patience{5};
  constexpr std::chrono::milliseconds between_tries{2};
  const int operation = (kind == Kind::alone ? LOCK_EX : LOCK_SH) | LOCK_NB;
  const auto deadline = std::chrono::steady_clock::now() + patience;
  for (;; std::this_thread::sleep_for(between_tries)) {
    descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0) return;
    const bool locked = ::flock(descriptor_, operation) == 0;
    if (locked && isStill(descriptor_, folder)) return;
    const bool hopeless = !locked && errno != EWOULDBLOCK;
    ::close(std::exchange(descriptor_, -1));
    if (hopeless || std::chrono::steady_clock::now() >= deadline) return;
  }
}

HeldFolder::~HeldFolder() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

HeldFolder::HeldFolder(HeldFolder&& from) noexcept : descriptor_(std::exchange(from.descriptor_, -1)) {}

/// The outermost folder is held first: a swap above would take the inner ones along.
std::vector<HeldFolder> heldWithFoldersAbove(const std::filesystem::path& folder) {
  std::vector<HeldFolder> held;
  std::filesystem::path at = folder.root_path();
  for (const std::filesystem::path& name : folder.relative_path())
    held.emplace_back(at /= name, HeldFolder::Kind::with_others);
  return held;
}

}  // namespace ursula
