#include "base/deadline.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

namespace ursula {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double longest = 1e9;  // s; a clock of nanoseconds has 64 bits

}  // namespace

bool isShortage(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr || dynamic_cast<const OutOfTime*>(&error) != nullptr;
}

struct Deadline::Shared {
  double seconds = 0;
  Clock::time_point end = Clock::time_point::max();
  std::function<bool()> asked_to_end;
  std::atomic<bool> ended{false}, removed{false};
};

Deadline::Deadline(double seconds, std::function<bool()> asked_to_end) {
  if (seconds <= 0 && !asked_to_end) return;
  shared_ = std::make_shared<Shared>();
  shared_->asked_to_end = std::move(asked_to_end);
  if (seconds <= 0) return;
  shared_->seconds = seconds;
  const std::chrono::duration<double> left(std::min(seconds, longest));
  shared_->end = Clock::now() + std::chrono::duration_cast<Clock::duration>(left);
}

Deadline Deadline::part() const {
  Deadline out;
  out.shared_ = std::make_shared<Shared>();
  if (!isSet()) return out;
  out.shared_->seconds = shared_->seconds;
  out.shared_->end = shared_->end;
  out.shared_->asked_to_end = shared_->asked_to_end;
  return out;
}

void Deadline::end() const {
  if (shared_) shared_->ended = true;
}

void Deadline::remove() const {
  if (shared_) shared_->removed = true;
}

bool Deadline::isOver() const {
  return shared_ && !shared_->removed &&
         (shared_->ended || Clock::now() >= shared_->end || (shared_->asked_to_end && shared_->asked_to_end()));
}

void Deadline::require() const {
  if (!isOver()) return;
  const bool late = Clock::now() >= shared_->end;
  throw OutOfTime(late ? fmt::format("the time limit of {:g} s was reached", shared_->seconds) : "it was asked to end");
}

}  // namespace ursula
