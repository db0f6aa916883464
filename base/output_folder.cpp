#include "base/output_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "base/output_file.h"
#include "base/sha1.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;

constexpr const char *unfinished = "new", *whole = "old";
enum class Carry { linked, moved };

bool isThere(const fs::path& path) { return fs::exists(fs::symlink_status(path)); }
bool isFolder(const fs::path& path) { return fs::is_directory(fs::symlink_status(path)); }

fs::path withoutLinks(const fs::path& folder) {
  const fs::path path = fs::weakly_canonical(fs::absolute(endOfLinks(folder)));
  return path.has_filename() ? path : path.parent_path();
}

/// Returns whether the folder is a mount point. A rename would move the mount; a removal would empty the other file
/// system.
bool isMountPoint(const fs::path& path) {
  struct statx own {};
  struct statx above {};
  ::statx(AT_FDCWD, path.c_str(), AT_SYMLINK_NOFOLLOW, STATX_TYPE, &own);
  ::statx(AT_FDCWD, path.parent_path().c_str(), 0, STATX_TYPE, &above);
  return (own.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0 || own.stx_dev_major != above.stx_dev_major ||
         own.stx_dev_minor != above.stx_dev_minor;
}

/// Lists all paths relative to `top`, folders before their content. Links to folders count as files.
std::vector<fs::path> allIn(const fs::path& top, const fs::path& below = "") {
  std::vector<fs::path> all;
  for (const fs::directory_entry& entry : fs::directory_iterator(top / below)) {
    const fs::path name = below / entry.path().filename();
    if (isMountPoint(top / name))
      throw fs::filesystem_error("is mounted", top / name, std::make_error_code(std::errc::device_or_resource_busy));
    all.push_back(name);
    if (!isFolder(top / name)) continue;
    const std::vector<fs::path> deeper = allIn(top, name);
    all.insert(all.end(), deeper.begin(), deeper.end());
  }
  return all;
}

/// Gives the folder the model's mode and, if the system permits, its owner.
void becomeLike(const fs::path& folder, const fs::path& model) {
  struct stat found {};
  if (::stat(model.c_str(), &found) != 0) return;
  static_cast<void>(::chown(folder.c_str(), found.st_uid, found.st_gid) == 0);
  ::chmod(folder.c_str(), found.st_mode & 07777);
}

void makeLike(const fs::path& folder, const fs::path& model) {
  if (isThere(folder)) return;
  makeLike(folder.parent_path(), model.parent_path());
  fs::create_directory(folder);
  becomeLike(folder, model);
}

/// Returns whether `a` was written after `b`; false if both are the same file, linked or copied.
bool isNewer(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::last_write_time(a, ignored) > fs::last_write_time(b, ignored);
}

/// Carries what is not `ours` from `old` into `fresh`. Carry::linked makes links, or copies if the file system has no
/// links. Carry::moved moves what `fresh` lacks or what changed since. Throws what the file system throws.
void carry(const fs::path& old, const fs::path& fresh, const Paths& ours, Carry how) {
  for (const fs::path& name : allIn(old)) {
    const fs::path from = old / name, to = fresh / name;
    const bool is_folder = isFolder(from), is_there = isThere(to);
    if (is_there && isFolder(to) != is_folder)
      throw std::runtime_error(from.string() + ": is a " +
                               (is_folder ? "folder, expected a file" : "file, expected a folder"));
    if (ours.count(name) != 0 || (is_there && (is_folder || how == Carry::linked || !isNewer(from, to)))) continue;
    makeLike(is_folder ? to : to.parent_path(), is_folder ? from : from.parent_path());
    if (is_folder) continue;
    if (how == Carry::moved)
      fs::rename(from, to);
    else if (::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), 0) != 0)
      fs::copy(from, to, fs::copy_options::copy_symlinks);
  }
}

void syncFolders(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (isFolder(entry.path())) syncFolders(entry.path());
  syncFolder(folder);
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, OlderFiles older)
    : shown_(std::move(folder)),
      folder_(withoutLinks(shown_)),
      above_(folder_.parent_path()),
      lock_file_(above_ / (".ursula-" + own("lock"))),
      older_(std::move(older)) {
  requireWritableFolder(shown_, shown_);
  if (isFolder(folder_)) requireSwappable();
  lock();
  if (is_alone_) sweep();
}

OutputFolder::~OutputFolder() {
  const DeferredSignals held;
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);  // and what was carried over into it
  fresh_.remove();                                               // removes the lock file while it is still locked
  if (lock_ >= 0) ::close(lock_);
}

/// Refuses an impossible swap before anything is computed. A process whose working folder is swapped would be left in a
/// removed one.
void OutputFolder::requireSwappable() const {
  std::error_code error;
  const fs::path here = fs::current_path(error), below = shown_ / "results";
  if (isMountPoint(folder_))
    refuseToWrite(shown_, "is a mount point, expected another folder, such as " + below.string());
  if (!error && std::mismatch(folder_.begin(), folder_.end(), here.begin(), here.end()).first == folder_.end())
    refuseToWrite(shown_, std::string(folder_ == here ? "is the working folder" : "has the working folder in it") +
                              ", expected another folder, such as " + below.string());
  requireWritableFolder(above_, shown_);
  const HeldFolder alone(folder_, HeldFolder::Kind::alone);
  try {
    allIn(folder_);
  } catch (const fs::filesystem_error& in_the_way) {
    refuseToWrite(shown_, in_the_way.path1().string() + " cannot be carried over: " + in_the_way.code().message());
  }
}

/// Returns a name of fixed length that is unique among the folders in `above_`.
std::string OutputFolder::own(const std::string& kind) const {
  return kind + "-" + sha1(folder_.filename().string()).substr(0, 12);
}

/// Waits some seconds for another writer to end.
void OutputFolder::lock() {
  constexpr std::chrono::seconds patience{2};
  constexpr std::chrono::milliseconds between_tries{20};
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!tryToLock()) {
    if (std::chrono::steady_clock::now() >= deadline) {
      std::string process;
      std::ifstream(lock_file_) >> process;
      throw std::runtime_error(shown_.string() + ": another run" +
                               (process.empty() ? "" : " (process " + process + ")") +
                               " is writing there, expected a folder that no other run has");
    }
    std::this_thread::sleep_for(between_tries);
  }
  const std::string process = std::to_string(::getpid()) + "\n";
  static_cast<void>(::ftruncate(lock_, 0) == 0 && writeAll(lock_, process));  // only for the message above
}

/// Tries once to get the lock. The previous holder removes the file and its new folders while it holds the lock, so the
/// opened file may have lost its name.
bool OutputFolder::tryToLock() {
  constexpr mode_t as_the_user_says = 0666;
  fresh_.makeFolder(above_);
  const DeferredSignals held;  // until the lock file is listed for removal
  lock_ = ::open(lock_file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, as_the_user_says);
  if (lock_ < 0 && errno == EACCES)  // another user's run left it: locking needs no write permission
    lock_ = ::open(lock_file_.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (lock_ < 0 && errno == ENOENT) return false;
  if (lock_ < 0) refuseToWrite(shown_, lock_file_.string() + ": " + std::strerror(errno));
  const Lock lock = tryLock(lock_);
  is_alone_ = lock == Lock::free && isStill(lock_, lock_file_);
  if (is_alone_ || lock == Lock::unknown) {
    fresh_.add(lock_file_);
    return true;
  }
  ::close(std::exchange(lock_, -1));
  return false;
}

/// Removes what dead processes left. Both folders of an interrupted swap are complete. If neither has its final name,
/// one gets it, and the newer files are carried over.
void OutputFolder::sweep() const {
  std::vector<fs::path> left;
  std::error_code error;
  for (fs::directory_iterator each(above_, error), end; !error && each != end; each.increment(error))
    left.push_back(each->path());
  const auto isOf = [this](const fs::path& path, const char* kind) {
    const std::string prefix = ".ursula-" + own(kind) + "-";
    return path.filename().string().compare(0, prefix.size(), prefix) == 0;
  };
  for (const fs::path& path : left) try {
      if (isOf(path, whole) && !isFolder(folder_)) {
        fs::rename(path, folder_);
      } else if (isOf(path, whole)) {
        Paths ours = olderIn(path);
        ours.merge(olderIn(folder_));
        carry(path, folder_, ours, Carry::moved);
        fs::remove_all(path);
      } else if (isOf(path, unfinished)) {
        fs::remove_all(path);
      }
    } catch (const std::runtime_error&) {  // another user's: it stays and harms nobody
    }
}

void OutputFolder::require(const fs::path& name) const { requireWritable(shown_ / name); }

void OutputFolder::write(const fs::path& name, const std::string& content) {
  write(name, [&content](const Take& take) { take(content); });
}

void OutputFolder::write(const fs::path& name, const std::function<void(const Take&)>& fill) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (temporary_.empty()) {
    held_above_ = heldWithFoldersAbove(above_);
    do temporary_ = temporaryIn(above_, own(unfinished));
    while (isThere(temporary_));
  }
  fresh_.makeFolder((temporary_ / name).parent_path());
  const int descriptor = fresh_.makeFile(temporary_ / name);
  const auto require = [&](bool done) {
    if (!done) refuseToWrite(shown_ / name, std::strerror(errno));
  };
  require(descriptor >= 0);
  try {
    fill([&](const std::string& piece) { require(writeAll(descriptor, piece)); });
    require(::fsync(descriptor) == 0);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  ::close(descriptor);
  written_.insert(name);
}

void OutputFolder::commit() {
  const DeferredSignals held;  // a signal meanwhile ends the process after the results are there
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    if (isFolder(folder_)) {
      swap();
    } else {
      syncFolders(temporary_);
      fs::rename(temporary_, folder_);
    }
  } catch (const fs::filesystem_error& error) {
    refuseToWrite(shown_, error.path1().string() + ": " + error.code().message());
  }
  syncFolder(above_);
  temporary_.clear();
  fresh_.keep();
  ::unlink(lock_file_.c_str());
  ::close(std::exchange(lock_, -1));
  held_above_.clear();
}

/// Swaps the folders. The new folder is first marked as complete by its name, so an interrupted swap leaves two
/// complete folders.
void OutputFolder::swap() {
  const HeldFolder alone(folder_, HeldFolder::Kind::alone);
  Paths ours = olderIn(folder_);
  ours.insert(written_.begin(), written_.end());
  carry(folder_, temporary_, ours, Carry::linked);
  becomeLike(temporary_, folder_);
  syncFolders(temporary_);
  fs::path old = temporaryIn(above_, own(whole));
  fs::rename(temporary_, old);
  temporary_ = old;
  if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, folder_.c_str(), RENAME_EXCHANGE) != 0) {  // as on NFS
    old = temporaryIn(above_, own(whole));
    fs::rename(folder_, old);
    std::error_code error;
    fs::rename(temporary_, folder_, error);
    if (error) fs::rename(old, folder_);
    if (error) throw fs::filesystem_error("cannot write", folder_, error);
  }
  temporary_.clear();
  syncFolder(above_);
  try {
    carry(old, folder_, ours, Carry::moved);
    fs::remove_all(old);
  } catch (const std::runtime_error&) {  // the results are there; the next run removes the rest
  }
}

}  // namespace ursula
