#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace ursula {

/// Thrown when the time is up. It is not a std::exception, because experiments turn those into results.
struct OutOfTime {
  std::string words;  ///< "the time limit of 600 s was reached", "it was asked to end"
};

/// Says when long work has to end: after some seconds, once somebody asks for it, or never (the default). It is cheap
/// to copy and to ask.
class Deadline {
 public:
  Deadline() = default;
  /// The work ends `seconds` from now (0: never), or as soon as `asked_to_end` returns true; it is polled.
  explicit Deadline(double seconds, std::function<bool()> asked_to_end = nullptr) : seconds_(seconds) {
    if (seconds <= 0 && !asked_to_end) return;
    const std::chrono::duration<double> left(seconds > 0 ? std::min(seconds, longest) : longest);
    end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(left);
    shared_ = std::make_shared<Shared>();
    shared_->asked_to_end = std::move(asked_to_end);
  }

  bool isSet() const { return shared_ != nullptr; }
  bool isOver() const {
    return shared_ && !shared_->removed && (Clock::now() >= end_ || (shared_->asked_to_end && shared_->asked_to_end()));
  }
  /// Removes the deadline from all copies: the remaining work is short and must be done.
  void remove() const {
    if (shared_) shared_->removed = true;
  }
  /// Throws OutOfTime if the time is over.
  void require() const {
    if (isOver()) throw OutOfTime{words()};
  }
  std::string words() const;

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double longest = 1e9;  ///< s; a clock of nanoseconds has 64 bits

  struct Shared {
    std::atomic<bool> removed{false};
    std::function<bool()> asked_to_end;
  };

  double seconds_ = 0;
  Clock::time_point end_;
  std::shared_ptr<Shared> shared_;
};

}  // namespace ursula
