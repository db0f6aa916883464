#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>

namespace ursula {

/// Thrown through work whose time is up. No std::exception, for of those an experiment makes a result of its own.
struct OutOfTime {
  std::string words;  ///< "the time limit of 600 s was reached"
};

/// When work that may take long has to end; never, where none is set. Cheap to copy and to ask.
class Deadline {
 public:
  Deadline() = default;
  /// `seconds` from now; 0: never.
  explicit Deadline(double seconds)
      : seconds_(seconds),
        end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(seconds, longest)))),
        lifted_(seconds > 0 ? std::make_shared<std::atomic<bool>>(false) : nullptr) {}

  bool isSet() const { return lifted_ != nullptr; }
  bool isOver() const { return lifted_ && !*lifted_ && Clock::now() >= end_; }
  /// For all copies: what is left is short, and is to be done.
  void lift() const {
    if (lifted_) *lifted_ = true;
  }
  /// Throws OutOfTime where it is over.
  void require() const {
    if (isOver()) throw OutOfTime{words()};
  }
  std::string words() const;

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double longest = 1e9;  ///< s; a clock of nanoseconds has 64 bits

  double seconds_ = 0;
  Clock::time_point end_;
  std::shared_ptr<std::atomic<bool>> lifted_;
};

}  // namespace ursula
