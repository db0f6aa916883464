#include "model/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace ursula {
namespace {

constexpr mode_t as_the_user_says = 0666;

/// Unique among processes by the process id, and among threads of this one by a count.
std::filesystem::path temporaryBeside(const std::filesystem::path& file) {
  static std::atomic<unsigned> count{0};
  std::filesystem::path name = file;
  name += ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(count++);
  return name;
}

/// A device, a pipe: to put a file in its place would take it from all who use it.
bool isNoFile(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

/// −1 where it cannot be, or could not be named afterwards.
int withoutName(const std::filesystem::path& file) {
#ifdef O_TMPFILE
  if (::access("/proc/self/fd", X_OK) != 0) return -1;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  return ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, as_the_user_says);
#else
  return static_cast<void>(file), -1;
#endif
}

/// Names what withoutName opened.
bool named(int descriptor, const std::filesystem::path& name) {
  const std::string here = "/proc/self/fd/" + std::to_string(descriptor);
  return ::linkat(AT_FDCWD, here.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path file) : file_(std::move(file)), in_place_(isNoFile(file_)) {
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path());
  open();
  if (descriptor_ < 0) fail();
}

void AtomicFile::open() {
  if (in_place_) {
    descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CLOEXEC);
    return;
  }
  descriptor_ = withoutName(file_);
  if (descriptor_ >= 0) return;
  temporary_ = temporaryBeside(file_);
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, as_the_user_says);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::fail() const {
  throw std::runtime_error("cannot write " + file_.string() + ": " + std::strerror(errno));
}

void AtomicFile::write(std::string_view piece) {
  while (!piece.empty()) {
    const ssize_t written = ::write(descriptor_, piece.data(), piece.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    piece.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  if (!in_place_ && temporary_.empty()) {
    const std::filesystem::path name = temporaryBeside(file_);
    if (!named(descriptor_, name)) fail();
    temporary_ = name;
  }
  const bool is_closed = ::close(std::exchange(descriptor_, -1)) == 0;
  if (!is_closed) fail();
  if (!in_place_) std::filesystem::rename(temporary_, file_);
  temporary_.clear();
}

void writeFileAtomically(const std::filesystem::path& file, const std::string& content) {
  AtomicFile out(file);
  out.write(content);
  out.commit();
}

}  // namespace ursula
