#include "base/deadline.h"

#include <fmt/format.h>

namespace ursula {

std::string Deadline::words() const {
  return Clock::now() >= end_ ? fmt::format("the time limit of {:g} s was reached", seconds_) : "it was asked to end";
}

}  // namespace ursula
