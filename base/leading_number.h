#pragma once

#include <cstddef>
#include <string_view>

namespace ursula {

/// What a text begins with.
struct LeadingNumber {
  double value = 0;
  std::size_t length = 0;  ///< 0 where it begins with no number, or with one that no double holds
};

/// Digits are as in C whatever the process's locale is: somebody's program may have set one with decimal commas. A
/// leading plus is read, white space is not.
LeadingNumber leadingNumber(std::string_view text);

}  // namespace ursula
