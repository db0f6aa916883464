#include "base/folder_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>
#include <utility>

#include "base/atomic_file.h"
#include "base/temporary_name.h"

namespace ursula {
namespace {

constexpr mode_t as_the_user_says = 0666;
constexpr std::chrono::seconds patience{2};
constexpr std::chrono::milliseconds between_tries{20};

}  // namespace

FolderLock::FolderLock(std::filesystem::path file, const std::filesystem::path& what) : file_(std::move(file)) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!take(what)) {
    if (std::chrono::steady_clock::now() >= deadline)
      throw FolderInUse(what.string() + ": another run" + holder() +
                        " is writing there, expected a folder that no other run has");
    std::this_thread::sleep_for(between_tries);
  }
  const std::string process = std::to_string(::getpid()) + "\n";
  static_cast<void>(::ftruncate(descriptor_, 0) == 0 && writeAll(descriptor_, process));  // only for the message above
}

void FolderLock::remove(const void* lock) { ::unlink(static_cast<const FolderLock*>(lock)->file_.c_str()); }

/// The one before removes the file while it still holds it: what was opened may have no name any more.
bool FolderLock::take(const std::filesystem::path& what) {
  const EndingHeld held;  // until it is known that the file is to go
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, as_the_user_says);
  if (descriptor_ < 0 && errno == EACCES)  // left by another user's run: to be locked it need not be written
    descriptor_ = ::open(file_.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor_ < 0 && errno == ENOENT) {  // the one before took the folders with it that it had made
    std::filesystem::create_directories(file_.parent_path());
    return false;
  }
  if (descriptor_ < 0)
    throw std::runtime_error("cannot write " + what.string() + ": " + file_.string() + ": " + std::strerror(errno));
  const Lock lock = tryLock(descriptor_);
  is_exclusive_ = lock == Lock::free && isStill(descriptor_, file_);
  if (is_exclusive_ || lock == Lock::unknown) {
    ending_.emplace(remove, this);
    return true;
  }
  ::close(std::exchange(descriptor_, -1));
  return false;
}

std::string FolderLock::holder() const {
  std::string process;
  std::ifstream(file_) >> process;
  return process.empty() ? "" : " (process " + process + ")";
}

FolderLock::~FolderLock() {
  ending_.reset();  // once it is let go, another's file may have that name
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace ursula
