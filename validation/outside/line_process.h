#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/child_process.h"
#include "model/motion.h"

namespace ursula {

/// A command that answers lines on its standard input with lines on its standard output. Its standard error is ours. It
/// and all its children end with this object or this process, see ChildProcess. For one thread at a time.
class LineProcess {
 public:
  /// The reason why `text` ends.
  enum class End { line, closed, late, too_long };
  struct Answer {
    std::string text;  ///< without the line's end
    End end = End::line;
  };
  using Environment = std::vector<std::pair<std::string, std::string>>;

  /// Starts `sh -c command` with additional environment variables. Throws std::system_error on failure.
  LineProcess(const std::string& command, const Environment& environment);

  /// Writes the line and reads an answer, within `timeout` seconds in all.
  Answer ask(const std::string& line, double timeout);

  /// Returns unrequested output received so far.
  std::string unasked();

  /// Returns how the command ended after it closed its output: "ended with exit code 3". Kills the rest.
  std::string ending();

  /// Closes its input and waits `grace` seconds for its end.
  void finish(double grace);

 private:
  bool write(const std::string& text, double deadline);
  /// Waits for more output; returns false at its end, with `ended` set, or at the deadline.
  bool receive(double deadline, bool& ended);

  ChildProcess process_;
  std::string received_;
};

/// A wrong answer of the solver's process, with question and answer.
class SolverProcessError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The question for one motion without line end: t, p, q, v, w, a, alpha as in the program's files. They are in B, SI,
/// with w ≥ 0 in q, 17 significant digits, separated by commas.
std::string solverQuestion(const Motion<double>& motion);

/// Parses six comma-separated efforts in the order of the motors, N·m or N. Throws SolverProcessError with the defect
/// of `line`.
Vector6d solverAnswer(const std::string& line);
/// The same for any number of numbers; `what` they are, for messages.
Eigen::VectorXd solverAnswer(const std::string& line, int count, const char* what = "effort");

/// The question to a simulator: t, p, q, v, w, then the six efforts.
std::string simulatorQuestion(const Motion<double>& state, const Vector6d& efforts);

/// The largest part of an answer in messages, in bytes.
constexpr std::size_t most_shown = 600;

}  // namespace ursula
