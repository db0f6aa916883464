#include "base/carry_over.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <stdexcept>
#include <tuple>
#include <vector>

#include "base/mount_point.h"

namespace ursula {
namespace {

namespace fs = std::filesystem;

bool isFolder(const fs::path& path) { return fs::is_directory(fs::symlink_status(path)); }
bool isThere(const fs::path& path) { return fs::exists(fs::symlink_status(path)); }

/// Folders come before what is in them; links to folders are no folders.
std::vector<fs::path> allIn(const fs::path& folder) {
  std::vector<fs::path> all;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    all.push_back(entry.path().lexically_relative(folder));
  return all;
}

/// With the mode of the other and, where the system lets it, the owner.
void makeLike(const fs::path& folder, const fs::path& model) {
  if (isThere(folder)) return;
  if (folder.has_parent_path() && model.has_parent_path()) makeLike(folder.parent_path(), model.parent_path());
  fs::create_directory(folder);
  struct stat found {};
  if (::stat(model.c_str(), &found) != 0) return;
  static_cast<void>(::chown(folder.c_str(), found.st_uid, found.st_gid) == 0);
  ::chmod(folder.c_str(), found.st_mode & 07777);
}

void linkOrCopy(const fs::path& from, const fs::path& to) {
  if (::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), 0) != 0)
    fs::copy(from, to, fs::copy_options::copy_symlinks);
}

/// The same file, linked or copied, is not.
bool isNewer(const fs::path& a, const fs::path& b) {
  struct stat of_a {};
  struct stat of_b {};
  if (::lstat(a.c_str(), &of_a) != 0) return false;
  if (::lstat(b.c_str(), &of_b) != 0) return true;
  const timespec &changed_a = of_a.st_mtim, &changed_b = of_b.st_mtim;
  return std::tie(changed_a.tv_sec, changed_a.tv_nsec) > std::tie(changed_b.tv_sec, changed_b.tv_nsec);
}

}  // namespace

void carryOver(const fs::path& old, const fs::path& fresh, const Paths& leave) {
  for (const fs::path& relative : allIn(old)) {
    const fs::path from = old / relative, to = fresh / relative;
    const bool is_ours = leave.count(relative) != 0;
    if (isThere(to)) {
      if (isFolder(to) != isFolder(from))
        throw std::runtime_error(from.string() + ": is a " +
                                 (isFolder(from) ? "folder, expected a file" : "file, expected a folder"));
    } else if (!is_ours && isFolder(from)) {
      makeLike(to, from);
    } else if (!is_ours) {
      makeLike(to.parent_path(), from.parent_path());
      linkOrCopy(from, to);
    }
  }
}

void bringAfter(const fs::path& old, const fs::path& fresh, const Paths& leave, const Paths& written) {
  if (holdsMountPoint(old)) return;  // what is removed here would be the other file system's
  for (const fs::path& relative : allIn(old)) {
    const fs::path from = old / relative, to = fresh / relative;
    if (isFolder(from) || leave.count(relative) != 0 || written.count(relative) != 0 || !isNewer(from, to)) continue;
    makeLike(to.parent_path(), from.parent_path());
    fs::rename(from, to);
  }
  fs::remove_all(old);
}

}  // namespace ursula
