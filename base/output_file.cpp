#include "base/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace ursula {
namespace {

namespace fs = std::filesystem;

constexpr mode_t anybody_writes = S_IWUSR | S_IWGRP | S_IWOTH, all_bits = 07777, plain_bits = 0777;
constexpr const char* file_kind = "file";

fs::path folderOf(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : "."; }

bool isLink(const fs::path& file) {
  std::error_code ignored;
  return fs::is_symlink(fs::symlink_status(file, ignored));
}

/// Returns whether the link leads to an open file, which may have no name or another's.
bool isOpenElsewhere(const fs::path& link) {
  std::error_code error;
  const fs::path folder = fs::canonical(link.parent_path(), error);
  return !error && folder.string().compare(0, 6, "/proc/") == 0;
}

/// Returns whether it is a device, a pipe or an open file, whose users would lose it if it were replaced.
bool isWrittenThrough(const fs::path& end) {
  std::error_code ignored;
  const fs::file_status status = fs::status(end, ignored);
  return isLink(end) || (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status));
}

/// Some systems write-protect these folders, but root can write there all the same.
bool isRootsOwn(const fs::path& folder) {
  const char* home = std::getenv("HOME");
  return ::geteuid() == 0 && (folder == "/" || (home != nullptr && folder == home));
}

/// Removes files whose process is gone and thus holds no lock. Nobody else removes a file that is locked here, so its
/// name cannot pass to another file before the removal.
void sweepTemporaries(const fs::path& folder) {
  const std::string prefix = std::string(".ursula-") + file_kind + "-";
  std::error_code error;
  for (fs::directory_iterator each(folder, error), end; !error && each != end; each.increment(error)) {
    const fs::path& name = each->path();
    if (name.filename().string().compare(0, prefix.size(), prefix) != 0) continue;
    const int descriptor = ::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (tryLock(descriptor) == Lock::free && isStill(descriptor, name)) ::unlink(name.c_str());
    ::close(descriptor);
  }
}

/// Gives the new file the mode and owner of the one that it replaces. Without the owner, it also drops the mode's
/// set-id bits.
void keepModeAndOwner(int descriptor, const fs::path& replaced) {
  struct stat old {};
  if (::stat(replaced.c_str(), &old) != 0) return;
  const bool is_kept = ::fchown(descriptor, old.st_uid, old.st_gid) == 0;
  ::fchmod(descriptor, old.st_mode & (is_kept ? all_bits : plain_bits));
}

}  // namespace

OutputFile::OutputFile(fs::path file) : file_(std::move(file)), end_(endOfLinks(file_)) {
  if (isWrittenThrough(end_)) {
    // An open file may already have content.
    descriptor_ = ::open(end_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  } else {
    requireWritable(file_);
    fresh_.makeFolder(end_.parent_path());
    sweepTemporaries(folderOf(end_));
    openTemporary();
  }
  if (descriptor_ < 0) refuseToWrite(file_, std::strerror(errno));
}

/// Retries, because another process may remove the file as abandoned before it is locked.
void OutputFile::openTemporary() {
  for (;;) {
    temporary_ = temporaryIn(folderOf(end_), file_kind);
    descriptor_ = fresh_.makeFile(temporary_);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0 || (tryLock(descriptor_) != Lock::taken && isStill(descriptor_, temporary_))) return;
    ::close(std::exchange(descriptor_, -1));
  }
}

OutputFile::~OutputFile() {
  fresh_.remove();  // before the lock is released
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::string_view piece) {
  if (!writeAll(descriptor_, piece)) refuseToWrite(file_, std::strerror(errno));
}

void OutputFile::commit() {
  const bool in_place = temporary_.empty();
  if (!in_place) {
    keepModeAndOwner(descriptor_, end_);
    if (::fsync(descriptor_) != 0) refuseToWrite(file_, std::strerror(errno));
    fs::rename(temporary_, end_);
    fresh_.keep();
    syncFolder(folderOf(end_));
  }
  // A renamed file is on the disk already, so an error from close cannot matter.
  if (::close(std::exchange(descriptor_, -1)) != 0 && in_place) refuseToWrite(file_, std::strerror(errno));
}

void writeFileAtomically(const fs::path& file, const std::string& content) {
  OutputFile out(file);
  out.write(content);
  out.commit();
}

void refuseToWrite(const fs::path& file, const std::string& why) {
  throw std::runtime_error("cannot write " + file.string() + ": " + why);
}

fs::path endOfLinks(fs::path file) {
  constexpr int most_links = 40;  // as in Linux
  for (int links = 0; links < most_links; ++links) {
    if (!isLink(file) || isOpenElsewhere(file)) return file;
    file = file.parent_path() / fs::read_symlink(file);
  }
  refuseToWrite(file, "too many symbolic links");
}

void requireWritable(const fs::path& file) {
  const fs::path end = endOfLinks(file);
  if (isWrittenThrough(end)) return;
  if (!end.has_filename()) refuseToWrite(file, "is a folder, expected a file");
  if (end.filename().native().size() > NAME_MAX) refuseToWrite(file, std::strerror(ENAMETOOLONG));
  requireWritableFolder(folderOf(end), file);
  struct stat found {};
  if (::stat(end.c_str(), &found) != 0) {
    if (errno != ENOENT) refuseToWrite(file, std::strerror(errno));
    return;
  }
  if (S_ISDIR(found.st_mode)) refuseToWrite(file, "is a folder, expected a file");
  if ((found.st_mode & anybody_writes) == 0) refuseToWrite(file, "is read-only");
  if (::faccessat(AT_FDCWD, end.c_str(), W_OK, AT_EACCESS) != 0) refuseToWrite(file, std::strerror(errno));
}

/// Throws unless the folder, or its nearest existing parent, can be written into.
void requireWritableFolder(const fs::path& folder, const fs::path& shown) {
  fs::path there = endOfLinks(folder);
  for (const fs::path& name : there)
    if (name.native().size() > NAME_MAX) refuseToWrite(shown, std::strerror(ENAMETOOLONG));
  struct stat found {};
  while (::stat(there.c_str(), &found) != 0) {
    if (errno != ENOENT && errno != ENOTDIR) refuseToWrite(shown, std::strerror(errno));
    there = folderOf(there);
  }
  if (!S_ISDIR(found.st_mode)) refuseToWrite(shown, there.string() + " is a file, expected a folder");
  const std::string which = "the folder " + there.string();
  if ((found.st_mode & anybody_writes) == 0 && !isRootsOwn(there)) refuseToWrite(shown, which + " is read-only");
  if (::faccessat(AT_FDCWD, there.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    refuseToWrite(shown, which + ": " + std::strerror(errno));
}

}  // namespace ursula
