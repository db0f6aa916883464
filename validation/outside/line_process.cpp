#include "validation/outside/line_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <ctime>
#include <system_error>
#include <utility>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX asks for it

namespace ursula {
namespace {

/// An answer of six numbers has some 150 characters.
constexpr std::size_t longest_line = 1 << 16;

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::system_error(error, std::generic_category(), what);
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("no pipe to the solver", errno);
    read = ends[0];
    write = ends[1];
  }
  ~Pipe() {
    for (int end : {read, write})
      if (end >= 0) ::close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int read = -1, write = -1;
};

int release(int& end) { return std::exchange(end, -1); }

/// A write to a process that has ended is an error of the call's, not a signal that ends this one.
class WithoutPipeSignal {
 public:
  WithoutPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~WithoutPipeSignal() {
    const timespec at_once{};
    while (!was_pending_ && sigtimedwait(&pipe_, nullptr, &at_once) == -1 && errno == EINTR) continue;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutPipeSignal(const WithoutPipeSignal&) = delete;
  WithoutPipeSignal& operator=(const WithoutPipeSignal&) = delete;

 private:
  sigset_t pipe_, before_;
  bool was_pending_ = false;
};

/// A command need not look at the end of its input.
void endGroup(const void* leader) { ::kill(-*static_cast<const pid_t*>(leader), SIGKILL); }

/// `NAME=value` of ours, but for those set anew.
std::vector<std::string> environmentWith(const LineProcess::Environment& more) {
  std::vector<std::string> out;
  for (char** each = environ; *each != nullptr; ++each) {
    const std::string entry = *each;
    const bool anew = std::any_of(more.begin(), more.end(), [&entry](const auto& variable) {
      return entry.compare(0, variable.first.size() + 1, variable.first + '=') == 0;
    });
    if (!anew) out.push_back(entry);
  }
  for (const auto& [name, value] : more) out.push_back(name + '=' + value);
  return out;
}

pid_t spawn(const std::string& command, const LineProcess::Environment& more, int in, int out) {
  std::vector<std::string> arguments = {"sh", "-c", command}, environment = environmentWith(more);
  const auto pointers = [](std::vector<std::string>& texts) {
    std::vector<char*> each;
    for (std::string& text : texts) each.push_back(text.data());
    each.push_back(nullptr);
    return each;
  };
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, out, STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setpgroup(&attributes, 0);
  sigset_t none, as_usual;
  sigemptyset(&none);
  sigemptyset(&as_usual);
  sigaddset(&as_usual, SIGPIPE);
  sigaddset(&as_usual, SIGXFSZ);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &as_usual);
  pid_t pid = -1;
  const int error =
      posix_spawn(&pid, "/bin/sh", &files, &attributes, pointers(arguments).data(), pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) fail("'" + command + "' cannot be started", error);
  return pid;
}

/// Waits until `end` is ready for `events`; false at the deadline.
bool ready(int end, short events, double deadline) {
  pollfd waited{end, events, 0};
  for (;;) {
    const double left = std::max(0.0, deadline - now());
    const int milliseconds = static_cast<int>(std::min(std::ceil(1e3 * left), 1e9));
    const int count = ::poll(&waited, 1, milliseconds);
    if (count > 0) return true;
    if (count < 0 && errno != EINTR) fail("waiting for the solver", errno);
    if (count == 0 && now() >= deadline) return false;
  }
}

}  // namespace

LineProcess::LineProcess(const std::string& command, const Environment& environment) {
  Pipe there, back;
  const EndingHeld held;  // until it is known what a signal has to end
  pid_ = spawn(command, environment, there.read, back.write);
  ends_with_us_.emplace(endGroup, &pid_);
  to_ = release(there.write);
  from_ = release(back.read);
  ::fcntl(to_, F_SETFL, O_NONBLOCK);
  ::fcntl(from_, F_SETFL, O_NONBLOCK);
}

LineProcess::~LineProcess() {
  kill();
  for (int end : {to_, from_})
    if (end >= 0) ::close(end);
}

void LineProcess::kill() {
  if (pid_ < 0) return;
  ::kill(-pid_, SIGKILL);  // not yet waited for, so that the number is still the group's
  while (::waitpid(pid_, &status_, 0) < 0 && errno == EINTR) continue;
  ends_with_us_.reset();
  pid_ = -1;
}

bool LineProcess::write(const std::string& text, double deadline) {
  const WithoutPipeSignal guard;
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(to_, text.data() + done, text.size() - done);
    if (count >= 0)
      done += static_cast<std::size_t>(count);
    else if (errno == EPIPE)
      return false;
    else if (errno != EAGAIN && errno != EINTR)
      fail("writing to the solver", errno);
    else if (!ready(to_, POLLOUT, deadline))
      return false;
  }
  return true;
}

bool LineProcess::receive(double deadline, bool& ended) {
  std::array<char, 4096> some{};
  for (;;) {
    const ssize_t count = ::read(from_, some.data(), some.size());
    if (count > 0) {
      received_.append(some.data(), static_cast<std::size_t>(count));
      return true;
    }
    ended = count == 0;
    if (ended) return false;
    if (errno != EAGAIN && errno != EINTR) fail("reading from the solver", errno);
    if (!ready(from_, POLLIN, deadline)) return false;
  }
}

LineProcess::Answer LineProcess::ask(const std::string& line, double timeout) {
  const double deadline = now() + timeout;
  write(line + '\n', deadline);  // where that fails, what came instead of an answer says more
  bool ended = false;
  std::size_t end = received_.find('\n');
  while (end == std::string::npos) {
    const std::size_t before = received_.size();
    if (before > longest_line) return {received_.substr(0, longest_line), End::too_long};
    if (!receive(deadline, ended)) return {std::exchange(received_, ""), ended ? End::closed : End::late};
    end = received_.find('\n', before);
  }
  Answer out{received_.substr(0, end), End::line};
  received_.erase(0, end + 1);
  return out;
}

std::string LineProcess::unasked() {
  bool ended = false;
  if (received_.empty()) receive(0, ended);
  return received_;
}

std::string LineProcess::ending() {
  const double deadline = now() + 1;  // its output is closed: it is about to end
  siginfo_t seen{};
  while (pid_ >= 0 && ::waitid(P_PID, static_cast<id_t>(pid_), &seen, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         seen.si_pid == 0 && now() < deadline)
    ::poll(nullptr, 0, 1);
  const bool by_itself = seen.si_pid != 0;
  kill();
  if (!by_itself) return "closed its output";
  if (WIFEXITED(status_)) return fmt::format("ended with exit code {}", WEXITSTATUS(status_));
  return fmt::format("was ended by signal {}", WTERMSIG(status_));
}

void LineProcess::finish(double grace) {
  ::close(release(to_));
  const double deadline = now() + grace;
  bool ended = false;
  while (receive(deadline, ended) && received_.size() <= longest_line) continue;
  kill();
}

}  // namespace ursula
