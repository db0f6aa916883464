#include "base/atomic_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "base/atomic_file.h"
#include "base/mount_point.h"
#include "base/sha1.h"
#include "base/temporary_name.h"
#include "base/writable.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;

constexpr mode_t as_the_user_says = 0666;
constexpr const char *unfinished = "new", *replaced = "old";

fs::path withoutLinks(const fs::path& folder) {
  fs::path path = fs::weakly_canonical(fs::absolute(endOfLinks(folder)));
  return path.has_filename() ? path : path.parent_path();
}

bool isFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

bool canHoldFiles(const fs::path& folder) {
  try {
    requireWritableFolder(folder);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// Whoever works in it would be left in a folder that is gone.
bool isWorkedIn(const fs::path& folder) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  return !error && std::mismatch(folder.begin(), folder.end(), here.begin(), here.end()).first == folder.end();
}

bool exchanged(const fs::path& a, const fs::path& b) {
#if defined(SYS_renameat2) && defined(RENAME_EXCHANGE)
  return ::syscall(SYS_renameat2, AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
#else
  return static_cast<void>(a), static_cast<void>(b), false;
#endif
}

void syncFolders(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && !entry.is_symlink()) syncFolders(entry.path());
  syncFolder(folder);
}

void writeSynced(const fs::path& file, const fs::path& shown,
                 const std::function<void(const AtomicFolder::Take&)>& fill) {
  const auto require = [&shown](bool done) {
    if (!done) throw std::runtime_error("cannot write " + shown.string() + ": " + std::strerror(errno));
  };
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, as_the_user_says);
  require(descriptor >= 0);
  try {
    fill([&](const std::string& piece) { require(writeAll(descriptor, piece)); });
    require(::fsync(descriptor) == 0);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  ::close(descriptor);
}

}  // namespace

AtomicFolder::AtomicFolder(fs::path folder, OlderFiles older)
    : shown_(std::move(folder)), folder_(withoutLinks(shown_)), older_(std::move(older)) {
  requireWritableFolder(shown_);
  const fs::path above = folder_.parent_path();
  base_ = isFolder(folder_) && (isMountPoint(folder_) || !canHoldFiles(above)) ? folder_ : above;
  stays_ = isFolder(folder_) && (base_ == folder_ || isWorkedIn(folder_));
  {
    const EndingHeld held;  // until it is known what a signal has to take away
    parents_.make(base_);
    ending_.emplace(
        [](const void* folder) {
          static_cast<const AtomicFolder*>(folder)->removeMade();
          static_cast<const AtomicFolder*>(folder)->parents_.remove();
        },
        this);
  }
  lock_.emplace(base_ / (".ursula-" + own("lock")), shown_);
  if (lock_->isExclusive()) sweep();
}

AtomicFolder::~AtomicFolder() {
  const EndingHeld held;
  std::error_code ignored;
  removeMade();
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);  // what was carried over
}

/// May be called within a signal's handler; needs no descriptor, and no look into a folder that a umask forbids.
void AtomicFolder::removeMade() const {
  for (auto made = made_.rbegin(); made != made_.rend(); ++made)
    if (::unlink(made->c_str()) != 0) ::rmdir(made->c_str());
}

/// Of this folder alone, and short whatever its name.
std::string AtomicFolder::own(const std::string& kind) const {
  return kind + "-" + sha1(folder_.filename().string()).substr(0, 12);
}

/// What is locked by this process was left by dead ones. Of a swap that was cut off either folder is whole: the one
/// that has no name any more is put back, or what came into it last is brought after.
void AtomicFolder::sweep() const {
  std::vector<fs::path> left;
  for (const fs::directory_entry& entry : fs::directory_iterator(base_)) left.push_back(entry.path());
  const auto isOf = [this](const fs::path& path, const char* kind) {
    const std::string prefix = ".ursula-" + own(kind) + "-";
    return path.filename().string().compare(0, prefix.size(), prefix) == 0;
  };
  for (const fs::path& path : left) try {
      if (isOf(path, unfinished)) {
        fs::remove_all(path);
      } else if (isOf(path, replaced) && !isFolder(folder_)) {
        fs::rename(path, folder_);
      } else if (isOf(path, replaced)) {
        bringAfter(path, folder_, older_(path), older_(folder_));
      }
    } catch (const fs::filesystem_error&) {  // another user's: it stays, and is in nobody's way
    }
}

void AtomicFolder::require(const fs::path& name) const { requireWritable(shown_ / name); }

void AtomicFolder::write(const fs::path& name, const std::string& content) {
  write(name, [&content](const Take& take) { take(content); });
}

void AtomicFolder::write(const fs::path& name, const std::function<void(const Take&)>& fill) {
  const std::lock_guard<std::mutex> lock(mutex_);
  {
    const EndingHeld held;  // until it is known what a signal has to take away
    if (temporary_.empty()) {
      fs::path fresh;
      do fresh = temporaryIn(base_, own(unfinished));
      while (!fs::create_directory(fresh));
      made_.push_back(temporary_ = fresh);
    }
    makeFolder(temporary_ / name.parent_path());
    made_.push_back(temporary_ / name);
  }
  writeSynced(temporary_ / name, shown_ / name, fill);
  written_.push_back(name);
}

/// Within the temporary one.
void AtomicFolder::makeFolder(const fs::path& folder) {
  if (isFolder(folder)) return;
  makeFolder(folder.parent_path());
  fs::create_directory(folder);
  made_.push_back(folder);
}

void AtomicFolder::makeLikeOld() const {
  struct stat found {};
  if (::stat(folder_.c_str(), &found) != 0) return;
  static_cast<void>(::chown(temporary_.c_str(), found.st_uid, found.st_gid) == 0);
  ::chmod(temporary_.c_str(), found.st_mode & 07777);
}

void AtomicFolder::commit() {
  const EndingHeld held;  // who ends it meanwhile, ends it with the results there
  const std::lock_guard<std::mutex> lock(mutex_);
  if (stays_) {
    replaceOneByOne();
  } else if (isFolder(folder_)) {
    swap();
  } else {
    syncFolders(temporary_);
    fs::rename(temporary_, folder_);
  }
  syncFolder(base_);
  temporary_.clear();
  made_.clear();
  parents_.keep();
  lock_.reset();
}

/// Its name says that it is whole before it is swapped: a swap that is cut off leaves two whole folders.
void AtomicFolder::swap() {
  const Paths leave = older_(folder_);
  if (holdsMountPoint(folder_)) return replaceOneByOne();
  try {
    carryOver(folder_, temporary_, leave);
  } catch (const fs::filesystem_error&) {  // something of somebody else's, which cannot be linked or read
    return replaceOneByOne();
  }
  makeLikeOld();
  syncFolders(temporary_);
  const fs::path old = temporaryIn(base_, own(replaced));
  fs::rename(temporary_, old);
  if (!exchanged(old, folder_)) {
    fs::rename(old, temporary_);
    std::error_code error;
    fs::rename(folder_, old, error);
    if (error) return replaceOneByOne();  // as folders of a lower layer cannot be renamed
    fs::rename(temporary_, folder_, error);
    if (error) fs::rename(old, folder_);
    if (error) throw fs::filesystem_error("cannot write", folder_, error);
  }
  syncFolder(base_);
  try {
    bringAfter(old, folder_, leave, Paths(written_.begin(), written_.end()));
  } catch (const fs::filesystem_error&) {  // the results are there; the next run goes on with what is left
  }
}

/// A reader tells a mixture by the runs that the files name.
void AtomicFolder::replaceOneByOne() {
  const Paths older = older_(folder_);
  for (const fs::path& name : written_) {
    if (name.has_parent_path()) fs::create_directories(folder_ / name.parent_path());
    fs::rename(temporary_ / name, folder_ / name);
  }
  const Paths written(written_.begin(), written_.end());
  std::error_code ignored;
  for (auto name = older.rbegin(); name != older.rend(); ++name)  // folders after what is in them
    if (written.count(*name) == 0) fs::remove(folder_ / *name, ignored);
  for (const fs::path& name : written_) syncFolder((folder_ / name).parent_path());  // others are not ours to enter
  fs::remove_all(temporary_, ignored);  // the results are there; the next run removes what is left
}

}  // namespace ursula
