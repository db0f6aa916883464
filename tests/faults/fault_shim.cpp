// A library to preload. It numbers the calls that write below FAULTS_FOLDER, also over forked processes. Call number
// FAULTS_AT fails with FAULTS_ERROR (an errno) instead of being made; the others go to the C library. The file
// FAULTS_LOG gets a line for each: "NUMBER CALL PATH". Without FAULTS_AT all succeed.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

struct Plan {
  const char* folder = nullptr;
  long at = 0;
  int error = EIO;
  int log = -1;
  std::atomic<long>* count = nullptr;  ///< shared with forked processes

  Plan() {
    const char* log_file = std::getenv("FAULTS_LOG");
    if (log_file == nullptr || std::getenv("FAULTS_FOLDER") == nullptr) return;
    if (const char* text = std::getenv("FAULTS_AT")) at = std::atol(text);
    if (const char* text = std::getenv("FAULTS_ERROR")) error = std::atoi(text);
    log = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, log_file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
    void* shared = ::mmap(nullptr, sizeof(*count), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) return;
    count = new (shared) std::atomic<long>(0);
    folder = std::getenv("FAULTS_FOLDER");
  }
};

Plan& plan() {
  static Plan made;
  return made;
}

bool isBelow(const char* path) {
  const std::size_t length = std::strlen(plan().folder);
  return std::strncmp(path, plan().folder, length) == 0 && (path[length] == '/' || path[length] == '\0');
}

/// Whether this call must fail; sets errno.
bool failsAt(const char* call, const char* path) {
  const long number = ++*plan().count;
  char line[PATH_MAX + 64];
  const int length = std::snprintf(line, sizeof line, "%ld %s %s\n", number, call, path);
  ::syscall(SYS_write, plan().log, line, static_cast<std::size_t>(length));
  if (number != plan().at) return false;
  errno = plan().error;
  return true;
}

bool fails(const char* call, const char* path) {
  if (plan().folder == nullptr || path == nullptr) return false;
  char full[PATH_MAX] = "";
  if (path[0] != '/' && ::syscall(SYS_getcwd, full, sizeof full - 1) > 0) std::strcat(full, "/");
  std::strncat(full, path, sizeof full - std::strlen(full) - 1);
  return isBelow(full) && failsAt(call, full);
}

bool fails(const char* call, int descriptor) {
  if (plan().folder == nullptr) return false;
  char link[64], path[PATH_MAX];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const long length = ::syscall(SYS_readlink, link, path, sizeof path - 1);
  if (length <= 0) return false;
  path[length] = '\0';
  return isBelow(path) && failsAt(call, path);
}

bool writes(int flags) { return (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0; }

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

mode_t modeOf(int flags, va_list rest) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? static_cast<mode_t>(va_arg(rest, int)) : 0;
}

}  // namespace

// Defines a call that may fail, from its declaration, its path or descriptor, and its arguments.
#define FAILS_ON(what, result, name, parameters, arguments, ...)                         \
  extern "C" __attribute__((visibility("default"))) result name parameters __VA_ARGS__ { \
    static const auto real = next<result(*) parameters>(#name);                          \
    return fails(#name, what) ? -1 : real arguments;                                     \
  }

#define OPENS(name)                                                                              \
  extern "C" __attribute__((visibility("default"))) int name(const char* path, int flags, ...) { \
    static const auto real = next<int (*)(const char*, int, ...)>(#name);                        \
    va_list rest;                                                                                \
    va_start(rest, flags);                                                                       \
    const mode_t mode = modeOf(flags, rest);                                                     \
    va_end(rest);                                                                                \
    return writes(flags) && fails(#name, path) ? -1 : real(path, flags, mode);                   \
  }

OPENS(open)
OPENS(open64)
FAILS_ON(file, ssize_t, write, (int file, const void* data, size_t size), (file, data, size))
FAILS_ON(file, ssize_t, pwrite, (int file, const void* data, size_t size, off_t at), (file, data, size, at))
FAILS_ON(file, ssize_t, pwrite64, (int file, const void* data, size_t size, off64_t at), (file, data, size, at))
FAILS_ON(file, int, fsync, (int file), (file))
FAILS_ON(file, int, fdatasync, (int file), (file))
FAILS_ON(file, int, flock, (int file, int operation), (file, operation), __THROW)
FAILS_ON(file, int, fchmod, (int file, mode_t mode), (file, mode), __THROW)
FAILS_ON(file, int, fchown, (int file, uid_t user, gid_t group), (file, user, group), __THROW)
FAILS_ON(file, int, ftruncate, (int file, off_t length), (file, length), __THROW)
FAILS_ON(file, int, ftruncate64, (int file, off64_t length), (file, length), __THROW)
FAILS_ON(path, int, chmod, (const char* path, mode_t mode), (path, mode), __THROW)
FAILS_ON(path, int, chown, (const char* path, uid_t user, gid_t group), (path, user, group), __THROW)
FAILS_ON(path, int, mkdir, (const char* path, mode_t mode), (path, mode), __THROW)
FAILS_ON(path, int, rmdir, (const char* path), (path), __THROW)
FAILS_ON(path, int, unlink, (const char* path), (path), __THROW)
FAILS_ON(path, int, remove, (const char* path), (path), __THROW)
FAILS_ON(to, int, rename, (const char* from, const char* to), (from, to), __THROW)
FAILS_ON(to, int, renameat2, (int in, const char* from, int at, const char* to, unsigned flags),
         (in, from, at, to, flags), __THROW)
FAILS_ON(to, int, linkat, (int in, const char* from, int at, const char* to, int flags), (in, from, at, to, flags),
         __THROW)

extern "C" __attribute__((visibility("default"))) int unlinkat(int folder, const char* path, int flags) __THROW {
  static const auto real = next<int (*)(int, const char*, int)>("unlinkat");
  return (folder == AT_FDCWD ? fails("unlinkat", path) : fails("unlinkat", folder)) ? -1 : real(folder, path, flags);
}

/// A failed close still closes the descriptor.
extern "C" __attribute__((visibility("default"))) int close(int file) {
  static const auto real = next<int (*)(int)>("close");
  const bool is_to_fail = fails("close", file);
  const int error = errno, result = real(file);
  if (!is_to_fail) return result;
  errno = error;
  return -1;
}

/// Files that SQLite shares.
extern "C" __attribute__((visibility("default"))) void* mmap64(void* at, size_t size, int protection, int flags,
                                                               int file, off64_t offset) __THROW {
  static const auto real = next<void* (*)(void*, size_t, int, int, int, off64_t)>("mmap64");
  if (file >= 0 && (flags & MAP_SHARED) != 0 && fails("mmap64", file)) return MAP_FAILED;
  return real(at, size, protection, flags, file, offset);
}

/// Locks.
extern "C" __attribute__((visibility("default"))) int fcntl64(int file, int command, ...) {
  static const auto real = next<int (*)(int, int, ...)>("fcntl64");
  va_list rest;
  va_start(rest, command);
  void* argument = va_arg(rest, void*);
  va_end(rest);
  return command == F_SETLK && fails("fcntl64", file) ? -1 : real(file, command, argument);
}
