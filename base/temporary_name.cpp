#include "base/temporary_name.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <vector>

namespace ursula {
namespace {

std::string prefixOf(const std::string& kind) { return ".ursula-" + kind + "-"; }

/// Nobody else removes what this has locked, so that between look and removal the name cannot come to mean another.
void removeIfDead(const std::filesystem::path& name) {
  const int descriptor = ::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  if (tryLock(descriptor) == Lock::free && isStill(descriptor, name)) ::unlink(name.c_str());
  ::close(descriptor);
}

}  // namespace

std::filesystem::path temporaryIn(const std::filesystem::path& folder, const std::string& kind) {
  static std::atomic<unsigned> count{0};
  return folder / (prefixOf(kind) + std::to_string(::getpid()) + "-" + std::to_string(count++));
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

void sweepTemporaries(const std::filesystem::path& folder, const std::string& kind) {
  const std::string prefix = prefixOf(kind);
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (std::filesystem::directory_iterator each(folder, error), end; !error && each != end; each.increment(error))
    if (each->path().filename().string().compare(0, prefix.size(), prefix) == 0) found.push_back(each->path());
  for (const std::filesystem::path& name : found) removeIfDead(name);
}

}  // namespace ursula
