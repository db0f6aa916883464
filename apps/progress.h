#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace ursula {

/// Shows the progress of work that takes more than two seconds, on stderr. A terminal shows a bar with the time left,
/// which the destructor removes; other outputs get a line per tenth.
class Progress {
 public:
  enum class Lines { tenths, none };

  /// `what` starts each line; with Lines::none the caller writes the lines.
  explicit Progress(const std::string& what, Lines lines = Lines::tenths);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Sets the completed share, from 0 to 1; `note` describes it or the current work. Any thread may call this.
  void at(double share, const std::string& note);

  bool onTerminal() const { return on_terminal_; }

 private:
  using Clock = std::chrono::steady_clock;

  void keepDrawing();
  void draw();
  std::string timeText() const;
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  std::string what_;
  Lines lines_;
  bool on_terminal_;
  Clock::time_point start_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable ending_;
  bool ended_ = false, drawn_ = false, said_ = false;
  double share_ = 0, at_seconds_ = 0;  ///< the last share, and its time
  std::string note_;
  std::thread drawing_;
};

}  // namespace ursula
