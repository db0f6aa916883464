#include "base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX requires it

namespace ursula {
namespace {

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::system_error(error, std::generic_category(), what);
}

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("no pipe to a process", errno);
    read = ends[0];
    write = ends[1];
  }
  ~Pipe() {
    for (const int end : {read, write})
      if (end >= 0) ::close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int read = -1, write = -1;
};

/// Returns our environment as `NAME=value`; `more` replaces variables of the same names.
std::vector<std::string> environmentWith(const std::vector<std::pair<std::string, std::string>>& more) {
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

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> each;
  for (std::string& text : texts) each.push_back(text.data());
  each.push_back(nullptr);
  return each;
}

/// Starts a command. In the child every signal has its default action, even one that this program ignores or blocks.
class Start {
 public:
  explicit Start(short further_flags) {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes,
                             static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | further_flags));
    posix_spawnattr_setpgroup(&attributes, 0);
    sigset_t none, as_usual;
    sigemptyset(&none);
    sigemptyset(&as_usual);
    sigaddset(&as_usual, SIGPIPE);
    sigaddset(&as_usual, SIGXFSZ);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &as_usual);
  }
  ~Start() {
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
  }
  Start(const Start&) = delete;
  Start& operator=(const Start&) = delete;

  pid_t operator()(std::vector<std::string> words, std::vector<std::string> environment) const {
    pid_t pid = -1;
    const int error = posix_spawnp(&pid, words.front().c_str(), &files, &attributes, pointersTo(words).data(),
                                   pointersTo(environment).data());
    if (error != 0) fail(words.front() + " cannot be started", error);
    return pid;
  }

  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
};

/// Kills the group of the process, because a command may ignore the end of its input.
void endGroup(const void* leader) { ::kill(-*static_cast<const pid_t*>(leader), SIGKILL); }

/// The copy ignores SIGINT, which a terminal sends to all, and SIGPIPE. It dies with its parent.
void leaveToParent(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);
  std::signal(SIGINT, SIG_IGN);                                                 // the parent handles it
  if (std::signal(SIGTERM, SIG_DFL) == SIG_IGN) std::signal(SIGTERM, SIG_IGN);  // keeps what our starter chose
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace

ChildProcess::ChildProcess(const Command& command) : leads_group_(command.is_asked) {
  Pipe there, back;
  Start start(command.is_asked ? POSIX_SPAWN_SETPGROUP : 0);
  if (command.is_asked) posix_spawn_file_actions_adddup2(&start.files, there.read, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&start.files, back.write, STDOUT_FILENO);
  const DeferredSignals held;  // until the process that a signal must end is known
  pid_ = start(command.words, environmentWith(command.environment));
  if (leads_group_) ends_with_us_.emplace(endGroup, &pid_);
  if (command.is_asked) to_ = std::exchange(there.write, -1);
  from_ = std::exchange(back.read, -1);
}

ChildProcess::ChildProcess(const std::function<void(int from, int to)>& work) {
  Pipe there, back;
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ < 0) fail("no process for a worker", errno);
  if (pid_ == 0) try {
      leaveToParent(parent);
      ::close(std::exchange(there.write, -1));
      ::close(std::exchange(back.read, -1));
      work(there.read, back.write);
      ::_exit(0);
    } catch (...) {
      std::abort();
    }
  to_ = std::exchange(there.write, -1);
  from_ = std::exchange(back.read, -1);
}

ChildProcess::~ChildProcess() {
  kill();
  closePipes();
}

void ChildProcess::closeInput() {
  if (to_ >= 0) ::close(std::exchange(to_, -1));
}

void ChildProcess::closePipes() {
  closeInput();
  if (from_ >= 0) ::close(std::exchange(from_, -1));
}

bool ChildProcess::hasEnded() const {
  siginfo_t seen{};
  return pid_ < 0 ||
         (::waitid(P_PID, static_cast<id_t>(pid_), &seen, WEXITED | WNOHANG | WNOWAIT) == 0 && seen.si_pid != 0);
}

void ChildProcess::kill() {
  if (pid_ < 0) return;
  ::kill(leads_group_ ? -pid_ : pid_, SIGKILL);  // it was not waited for yet, so the id is still its own
  wait();
}

void ChildProcess::wait() {
  if (pid_ < 0) return;
  while (::waitpid(pid_, &status_, 0) < 0 && errno == EINTR) continue;
  ends_with_us_.reset();
  pid_ = -1;
}

std::string ChildProcess::howItEnded() const {
  if (WIFEXITED(status_)) return "ended with exit code " + std::to_string(WEXITSTATUS(status_));
  return "was ended by signal " + std::to_string(WTERMSIG(status_)) + " (" + ::strsignal(WTERMSIG(status_)) + ")";
}

std::string answerOf(const std::vector<std::string>& words, std::string_view input, const Deadline& deadline) {
  constexpr int milliseconds = 100;  // between looks at the deadline
  ChildProcess child({words, {}, true});
  ::fcntl(child.to(), F_SETFL, O_NONBLOCK);
  std::string out;
  std::array<char, 65536> some{};
  for (;;) {
    if (input.empty()) child.closeInput();
    std::array<pollfd, 2> ends{{{child.from(), POLLIN, 0}, {child.to(), POLLOUT, 0}}};  // poll passes over −1
    deadline.require();
    if (::poll(ends.data(), ends.size(), milliseconds) <= 0) continue;
    if (ends[1].revents != 0) {
      const ssize_t count = ::write(child.to(), input.data(), input.size());
      if (count < 0 && errno != EINTR && errno != EAGAIN) input = {};  // it ended; its status says why
      input.remove_prefix(count > 0 ? count : 0);
    }
    if (ends[0].revents == 0) continue;
    const ssize_t count = ::read(child.from(), some.data(), some.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    out.append(some.data(), count);
  }
  for (; !child.hasEnded(); ::poll(nullptr, 0, 1)) deadline.require();
  child.wait();
  if (child.status() != 0) throw std::runtime_error(words.front() + " " + child.howItEnded());
  return out;
}

void startDetached(const std::vector<std::string>& words) {
  Start start(POSIX_SPAWN_SETSID);
  posix_spawn_file_actions_addopen(&start.files, STDIN_FILENO, "/dev/null", O_RDWR, 0);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_adddup2(&start.files, STDIN_FILENO, stream);
  start(words, environmentWith({}));
}

}  // namespace ursula
