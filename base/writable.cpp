#include "base/writable.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace ursula {
namespace {

constexpr int most_links = 40;  // as Linux has it

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error("cannot write " + file.string() + ": " + why);
}

/// 0, or the error's number: 0 with no file too, of which `is_there` then knows.
int look(const std::filesystem::path& path, struct stat& found, bool& is_there) {
  is_there = ::stat(path.c_str(), &found) == 0;
  return is_there || errno == ENOENT ? 0 : errno;
}

/// Some systems keep these without permission to write, for root, who needs none.
bool isRootsOwn(const std::filesystem::path& folder) {
  const char* home = std::getenv("HOME");
  return ::geteuid() == 0 && (folder == "/" || (home != nullptr && folder == home));
}

void requireOpenFolder(const std::filesystem::path& shown, const std::filesystem::path& folder,
                       const struct stat& found) {
  if (!S_ISDIR(found.st_mode)) refuse(shown, folder.string() + " is a file, expected a folder");
  const bool by_mode = (found.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)) != 0 || isRootsOwn(folder);
  if (!by_mode) refuse(shown, "the folder " + folder.string() + " is read-only");
  if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    refuse(shown, "the folder " + folder.string() + ": " + std::strerror(errno));
}

/// Of the folders on the way, the last that is there may be written into, and the others could be made in it.
void requireFolderFor(const std::filesystem::path& shown, const std::filesystem::path& folder) {
  struct stat found {};
  bool is_there = false;
  std::filesystem::path there = folder;
  std::filesystem::path missing;
  for (int error = look(there, found, is_there); !is_there; error = look(there, found, is_there)) {
    if (error == ENOTDIR || error == 0) {
      missing = there.filename() / missing;
      there = there.has_parent_path() && there != there.parent_path() ? there.parent_path() : ".";
    } else {
      refuse(shown, std::strerror(error));
    }
  }
  requireOpenFolder(shown, there, found);
  // A name that is too long is so in any folder.
  for (const std::filesystem::path& name : missing)
    if (const int error = look(there / name, found, is_there); error != 0) refuse(shown, std::strerror(error));
}

bool isLink(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_symlink(std::filesystem::symlink_status(file, ignored));
}

/// What a process has open: the link leads to what may have no name, or another's.
bool isOpenElsewhere(const std::filesystem::path& link) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical(link.parent_path(), error);
  return !error && folder.string().compare(0, 6, "/proc/") == 0;
}

}  // namespace

std::filesystem::path endOfLinks(std::filesystem::path file) {
  for (int links = 0; links < most_links; ++links) {
    if (!isLink(file) || isOpenElsewhere(file)) return file;
    file = file.parent_path() / std::filesystem::read_symlink(file);
  }
  refuse(file, "too many symbolic links");
}

bool isWrittenThrough(const std::filesystem::path& end) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(end, ignored);
  return isLink(end) || (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
                         !std::filesystem::is_directory(status));
}

void requireWritable(const std::filesystem::path& file) {
  const std::filesystem::path end = endOfLinks(file);
  if (isWrittenThrough(end)) return;
  if (!end.has_filename()) refuse(file, "is a folder, expected a file");
  requireFolderFor(file, end.has_parent_path() ? end.parent_path() : ".");
  struct stat found {};
  bool is_there = false;
  if (const int error = look(end, found, is_there); error != 0) refuse(file, std::strerror(error));
  if (!is_there) return;
  if (S_ISDIR(found.st_mode)) refuse(file, "is a folder, expected a file");
  if ((found.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)) == 0) refuse(file, "is read-only");
  if (::faccessat(AT_FDCWD, end.c_str(), W_OK, AT_EACCESS) != 0) refuse(file, std::strerror(errno));
}

void requireWritableFolder(const std::filesystem::path& folder) { requireFolderFor(folder, endOfLinks(folder)); }

}  // namespace ursula
