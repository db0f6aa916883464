#include "base/mount_point.h"

#include <fcntl.h>
#include <sys/stat.h>

namespace ursula {

namespace fs = std::filesystem;

bool isMountPoint(const fs::path& path) {
#ifdef STATX_ATTR_MOUNT_ROOT
  struct statx found {};
  if (::statx(AT_FDCWD, path.c_str(), AT_SYMLINK_NOFOLLOW, STATX_TYPE, &found) == 0 &&
      (found.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) != 0)
    return (found.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
#endif
  struct stat own {};
  struct stat above {};
  return ::lstat(path.c_str(), &own) == 0 && ::stat(path.parent_path().c_str(), &above) == 0 &&
         (own.st_dev != above.st_dev || own.st_ino == above.st_ino);
}

bool holdsMountPoint(const fs::path& folder) {
  std::error_code ignored;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator each(folder, options, ignored), end; each != end; each.increment(ignored))
    if (isMountPoint(each->path())) return true;
  return false;
}

}  // namespace ursula
