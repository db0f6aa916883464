#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace ursula {

/// Thrown when the time is up. what() is "the time limit of 600 s was reached" or "it was asked to end".
struct OutOfTime : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns whether an error is a lack of memory or time, which says nothing about the machine. Code that turns errors
/// into results passes it on.
bool isShortage(const std::exception& error);

/// Says when long work has to end: after some seconds, once somebody asks for it, or never (the default). Copies share
/// one end. It is cheap to copy and to ask.
class Deadline {
 public:
  Deadline() = default;
  /// The work ends `seconds` from now (0: never), or as soon as `asked_to_end` returns true; it is polled.
  explicit Deadline(double seconds, std::function<bool()> asked_to_end = nullptr);

  /// Returns a deadline that is over with this one, or earlier by end().
  Deadline part() const;
  void end() const;
  /// Removes the deadline: the remaining work is short and must be done.
  void remove() const;

  bool isSet() const { return shared_ != nullptr; }
  bool isOver() const;
  /// Throws OutOfTime if the time is over.
  void require() const;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

}  // namespace ursula
