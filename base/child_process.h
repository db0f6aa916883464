#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/deadline.h"
#include "base/signal_cleanup.h"

namespace ursula {

/// A child process with pipes to it and from it. The destructor kills it if it still runs, and waits for it. Its
/// standard error is ours.
class ChildProcess {
 public:
  struct Command {
    std::vector<std::string> words;  ///< program, searched on PATH, and its arguments
    /// Variables added to ours; they replace those of the same name.
    std::vector<std::pair<std::string, std::string>> environment;
    /// The child gets a pipe to its standard input and leads its own process group. The group ends with it, or with a
    /// signal that ends this process. SIGKILL, crash signals and handled signals do not end the group.
    bool is_asked = false;
  };
  /// Throws std::system_error if it cannot be started; the code is ENOENT if there is no such program.
  explicit ChildProcess(const Command& command);
  /// Forks this process, which should have no threads that hold locks. The copy only does `work` with its ends of the
  /// pipes. It ends with its parent and ignores SIGINT and SIGPIPE.
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
  /// Waits until it has ended by itself.
  void wait();
  /// Returns the status from waitpid, once it was waited for.
  int status() const { return status_; }
  /// Returns "ended with exit code 3", "was ended by signal 9 (Killed)".
  std::string howItEnded() const;

 private:
  pid_t pid_ = -1;
  bool leads_group_ = false;
  int to_ = -1, from_ = -1;
  int status_ = 0;
  std::optional<CleanupOnSignal> ends_with_us_;
};

/// Runs a command without a shell, gives it `input` and returns its standard output. Throws like ChildProcess,
/// std::runtime_error if it fails, and OutOfTime at the deadline; then it is killed. The caller ignores SIGPIPE.
std::string answerOf(const std::vector<std::string>& words, std::string_view input = {}, const Deadline& deadline = {});

/// Starts a program in its own session, without our streams; nobody waits for it. Throws like ChildProcess.
void startDetached(const std::vector<std::string>& words);

}  // namespace ursula
