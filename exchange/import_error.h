#pragma once

#include <stdexcept>
#include <string>

namespace ursula::exchange {

/// A model that cannot be taken over: what is wrong, what was expected, what would help. Line of the file, 1-based; 0
/// where it is of no one line.
class ImportError : public std::runtime_error {
 public:
  explicit ImportError(const std::string& what, int at_line = 0) : std::runtime_error(what), line(at_line) {}

  int line;
};

}  // namespace ursula::exchange
