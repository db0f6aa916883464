#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/child_process.h"

namespace ursula {

/// A command that is asked line by line: what is written to its standard input is answered on its standard output. Its
/// standard error is ours. It ends with this object, or with this process, with all that it has started: see
/// ChildProcess. For one thread at a time.
class LineProcess {
 public:
  /// Why `text` is all that came.
  enum class End { line, closed, late, too_long };
  struct Answer {
    std::string text;  ///< without the line's end
    End end = End::line;
  };
  using Environment = std::vector<std::pair<std::string, std::string>>;

  /// Starts `sh -c command` with further variables in its environment. Throws std::system_error where it cannot be.
  LineProcess(const std::string& command, const Environment& environment);

  /// Writes the line and waits for one, for at most `timeout` seconds in all.
  Answer ask(const std::string& line, double timeout);

  /// What came beyond the lines asked for, by now.
  std::string unasked();

  /// How the command ended, in words, once its output is closed: "ended with exit code 3". Kills what is left.
  std::string ending();

  /// Closes its input, and gives it so many seconds to end by itself.
  void finish(double grace);

 private:
  bool write(const std::string& text, double deadline);
  /// Waits for more output until the deadline; false at its end, with `ended` set, or at the deadline.
  bool receive(double deadline, bool& ended);

  ChildProcess process_;
  std::string received_;
};

}  // namespace ursula
