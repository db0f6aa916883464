#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace ursula {

/// Says on stderr how far something is that takes more than two seconds: on a terminal a bar with the time left, which
/// goes when this does; elsewhere a line each tenth.
class Progress {
 public:
  enum class Lines { tenths, none };

  /// `what` begins each line; without lines the caller writes his own.
  explicit Progress(const std::string& what, Lines lines = Lines::tenths);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// So much of 1 is done; `note` says it in other words, or what is at work. From any thread.
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
  bool ended_ = false, drawn_ = false;
  double share_ = 0, at_seconds_ = 0;  ///< the last share, and when it was reached
  std::string note_;
  std::thread drawing_;
};

}  // namespace ursula
