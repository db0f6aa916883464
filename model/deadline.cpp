#include "model/deadline.h"

#include <fmt/format.h>

namespace ursula {

std::string Deadline::words() const { return fmt::format("the time limit of {:g} s was reached", seconds_); }

}  // namespace ursula
