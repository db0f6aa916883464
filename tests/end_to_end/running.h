#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "tests/end_to_end/program.h"

namespace ursula {

/// A run of the program that can be killed.
class Running {
 public:
  Running(const Program& ursula, const std::vector<std::string>& arguments) {
    std::vector<std::string> call = {URSULA_PROGRAM};
    call.insert(call.end(), arguments.begin(), arguments.end());
    process_ = ::fork();
    if (process_ != 0) return;
    const int nothing = ::open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) ::dup2(nothing, stream);
    std::vector<char*> pointers;
    for (std::string& each : call) pointers.push_back(each.data());
    pointers.push_back(nullptr);
    if (::chdir(ursula.folder().c_str()) == 0) ::execv(URSULA_PROGRAM, pointers.data());
    ::_exit(127);
  }
  ~Running() { kill(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  bool hasEnded() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid != 0;
  }
  void wait() {
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }
  void send(int signal) const { ::kill(process_, signal); }
  /// Waits for its end and returns the exit code; −1 if a signal ended it.
  int exitCode() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Waits for its end; whether that signal ended it.
  bool isEndedBy(int signal) {
    int status = 0;
    ::kill(process_, signal);
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return WIFSIGNALED(status) && WTERMSIG(status) == signal;
  }
  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }

 private:
  pid_t process_ = -1;
};

}  // namespace ursula
