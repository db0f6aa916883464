#pragma once

#include <stdexcept>
#include <string>

namespace ursula::exchange {

/// A model that cannot be imported: what is wrong, what was expected, what would help. The line of the file is 1-based,
/// or 0 if no single line causes it.
class ImportError : public std::runtime_error {
 public:
  explicit ImportError(const std::string& what, int at_line = 0) : std::runtime_error(what), line(at_line) {}

  int line;
};

}  // namespace ursula::exchange
