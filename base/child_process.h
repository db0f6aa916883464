#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/at_ending.h"

namespace ursula {

/// A process that this one starts, with pipes to it and from it. Where it still runs it is killed, and waited for, when
/// this goes. Its standard error is ours.
class ChildProcess {
 public:
  struct Command {
    std::vector<std::string> words;  ///< a program, looked for on PATH, and its arguments
    /// Variables beside ours, or in their place.
    std::vector<std::pair<std::string, std::string>> environment;
    /// It gets a pipe to its standard input, and leads a group of its own, which ends with it, or with a signal that
    /// ends this process where that has its default action, but for SIGKILL and those of a crash.
    bool is_asked = false;
  };
  /// Throws std::system_error where it cannot be started, with the code ENOENT where there is no such program.
  explicit ChildProcess(const Command& command);
  /// A copy of this process, which should have no threads that hold locks: it does `work` with its ends of the pipes,
  /// and no more. It ends with this one, and leaves to it what comes from a terminal.
  explicit ChildProcess(const std::function<void(int from, int to)>& work);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  int to() const { return to_; }
  int from() const { return from_; }
  void closeInput();
  void closePipes();
  bool hasEnded() const;
  void kill();
  /// Until it has ended by itself.
  void wait();
  /// What waitpid said of a process that was waited for.
  int status() const { return status_; }
  /// "ended with exit code 3", "was ended by signal 9 (Killed)".
  std::string howItEnded() const;

 private:
  pid_t pid_ = -1;
  bool leads_group_ = false;
  int to_ = -1, from_ = -1;
  int status_ = 0;
  std::optional<AtEnding> ends_with_us_;
};

/// Starts a program in a session of its own, without our streams; nobody waits for it. Throws as ChildProcess.
void startDetached(const std::vector<std::string>& words);

}  // namespace ursula
