#include "apps/command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace ursula {
namespace {

/// What comes until the last who holds the other end is gone.
std::string allOf(int from) {
  std::string out;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t got = ::read(from, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return out;
    out.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

int statusOf(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

std::string outputOf(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw std::runtime_error(fmt::format("no pipe to {}: {}", words.front(), std::strerror(errno)));
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
  posix_spawnattr_t attributes;  // signals that this program ignores, a command takes as usual
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  sigset_t as_usual;
  sigemptyset(&as_usual);
  sigaddset(&as_usual, SIGPIPE);
  sigaddset(&as_usual, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &as_usual);
  pid_t process = -1;
  const int refused = ::posix_spawnp(&process, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  ::close(ends[1]);
  std::string out = refused == 0 ? allOf(ends[0]) : "";
  ::close(ends[0]);
  if (refused == ENOENT) throw std::runtime_error(fmt::format("there is no {} on PATH", words.front()));
  if (refused != 0) throw std::runtime_error(fmt::format("cannot run {}: {}", words.front(), std::strerror(refused)));
  const int status = statusOf(process);
  if (status == 0) return out;
  throw std::runtime_error(WIFEXITED(status)
                               ? fmt::format("{} ended with {}", words.front(), WEXITSTATUS(status))
                               : fmt::format("{} was ended by signal {}", words.front(), WTERMSIG(status)));
}

}  // namespace ursula
