#include "apps/streams.h"

#include <execinfo.h>
#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

namespace ursula {

void sayText(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void secureStreams() {
  // Standard input still cannot be read, and standard output cannot be written.
  constexpr std::array<std::pair<int, int>, 3> streams = {
      {{STDIN_FILENO, O_WRONLY}, {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_WRONLY}}};
  for (const auto& [stream, access] : streams)
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF) ::open("/dev/null", access);  // gets the lowest free number
  for (const int error : {SIGPIPE, SIGXFSZ}) std::signal(error, SIG_IGN);
}

void loadUnwinder() {
  void* frame = nullptr;
  ::backtrace(&frame, 1);
}

void shareArenaInBoundedMemory() {
#ifdef __GLIBC__
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) ::mallopt(M_ARENA_MAX, 1);
#endif
}

std::string lostOutput() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return "";
  return std::string("standard output could not be written") + (errno == 0 ? "" : ": ") +
         (errno == 0 ? "" : std::strerror(errno));
}

}  // namespace ursula
