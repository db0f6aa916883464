#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "base/temporary_name.h"
#include "base/writable.h"

namespace ursula {
namespace {

constexpr mode_t as_the_user_says = 0666, all_bits = 07777;
constexpr const char* kind = "file";

/// −1 where it cannot be, or could not be named afterwards.
int withoutName(const std::filesystem::path& folder) {
#ifdef O_TMPFILE
  if (::access("/proc/self/fd", X_OK) != 0) return -1;
  return ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, as_the_user_says);
#else
  return static_cast<void>(folder), -1;
#endif
}

/// Names what withoutName opened.
bool named(int descriptor, const std::filesystem::path& name) {
  const std::string here = "/proc/self/fd/" + std::to_string(descriptor);
  return ::linkat(AT_FDCWD, here.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path file)
    : file_(std::move(file)), end_(endOfLinks(file_)), in_place_(isWrittenThrough(end_)) {
  if (!in_place_) {
    requireWritable(file_);
    parents_.make(end_.parent_path());
    sweepTemporaries(folder(), kind);
  }
  open();
  if (descriptor_ < 0) fail();
}

void AtomicFile::open() {
  if (in_place_) {
    // What a process has open may be a file with something in it.
    descriptor_ = ::open(end_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    return;
  }
  descriptor_ = withoutName(folder());
  if (descriptor_ >= 0)
    tryLock(descriptor_);
  else
    openNamed();
}

/// Until it is locked, another process may take it for one of the dead's.
void AtomicFile::openNamed() {
  for (;;) {
    temporary_ = temporaryIn(folder(), kind);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, as_the_user_says);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) temporary_.clear();
    if (descriptor_ < 0 || (tryLock(descriptor_) != Lock::taken && isStill(descriptor_, temporary_))) return;
    ::close(std::exchange(descriptor_, -1));
  }
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::filesystem::path AtomicFile::folder() const { return end_.has_parent_path() ? end_.parent_path() : "."; }

void AtomicFile::fail() const {
  throw std::runtime_error("cannot write " + file_.string() + ": " + std::strerror(errno));
}

void AtomicFile::write(std::string_view piece) {
  if (!writeAll(descriptor_, piece)) fail();
}

/// Of what is replaced. An owner that cannot be kept loses the bits that speak of him.
void AtomicFile::keepModeAndOwner() const {
  struct stat old {};
  if (::stat(end_.c_str(), &old) != 0) return;
  const bool is_kept = ::fchown(descriptor_, old.st_uid, old.st_gid) == 0;
  ::fchmod(descriptor_, old.st_mode & (is_kept ? all_bits : as_the_user_says | S_IXUSR | S_IXGRP | S_IXOTH));
}

void AtomicFile::takeName() {
  while (temporary_.empty()) {
    const std::filesystem::path name = temporaryIn(folder(), kind);
    if (named(descriptor_, name))
      temporary_ = name;
    else if (errno != EEXIST)
      fail();
  }
}

void AtomicFile::commit() {
  if (!in_place_) {
    keepModeAndOwner();
    if (::fsync(descriptor_) != 0) fail();
    takeName();
    std::filesystem::rename(temporary_, end_);
    temporary_.clear();
    parents_.keep();
    syncFolder(folder());
  }
  // What has a name is on the disk: nothing that closing says can take that back.
  if (::close(std::exchange(descriptor_, -1)) != 0 && in_place_) fail();
}

void writeFileAtomically(const std::filesystem::path& file, const std::string& content) {
  AtomicFile out(file);
  out.write(content);
  out.commit();
}

bool writeAll(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void syncFolder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace ursula
