#include "base/fresh_paths.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

namespace ursula {

FreshPaths::FreshPaths()
    : ending_([](const void* paths) { static_cast<const FreshPaths*>(paths)->unlinkAll(); }, this) {}

void FreshPaths::makeFolder(const std::filesystem::path& folder) {
  if (folder.empty() || std::filesystem::is_directory(folder)) return;
  makeFolder(folder.parent_path());
  const DeferredSignals held;  // until the path that a signal must remove is known
  if (std::filesystem::create_directory(folder)) made_.push_back(folder);
}

int FreshPaths::makeFile(const std::filesystem::path& file) {
  constexpr mode_t as_the_user_says = 0666;
  const DeferredSignals held;
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, as_the_user_says);
  if (descriptor >= 0) made_.push_back(file);
  return descriptor;
}

void FreshPaths::add(const std::filesystem::path& path) {
  const DeferredSignals held;
  made_.push_back(path);
}

void FreshPaths::keep() {
  const DeferredSignals held;
  made_.clear();
}

void FreshPaths::remove() {
  const DeferredSignals held;
  unlinkAll();
  made_.clear();
}

/// A signal handler may call this. It needs no descriptor and no permission to read the folder.
void FreshPaths::unlinkAll() const {
  for (auto made = made_.rbegin(); made != made_.rend(); ++made)
    if (::unlink(made->c_str()) != 0) ::rmdir(made->c_str());
}

std::filesystem::path temporaryIn(const std::filesystem::path& folder, const std::string& kind) {
  static std::atomic<unsigned> count{0};
  return folder / (".ursula-" + kind + "-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
}

Lock tryLock(int descriptor) {
  for (;;) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return Lock::free;
    if (errno == EWOULDBLOCK) return Lock::taken;
    if (errno != EINTR) return Lock::unknown;
  }
}

bool isStill(int descriptor, const std::filesystem::path& name) {
  struct stat open {};
  struct stat named {};
  return ::fstat(descriptor, &open) == 0 && ::lstat(name.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

bool writeAll(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(written);
  }
  return true;
}

void syncFolder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

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
