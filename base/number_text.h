#pragma once

#include <cstddef>

namespace ursula {

/// The length of the buffer that writeNumber may use; more than it returns.
constexpr std::size_t longest_number = 40;

/// Writes to `to` the same bytes as {fmt} for "{:.17g}" and returns their end. `to` has room for longest_number. It is
/// some five times as fast for sizes from 2⁻³⁶ to 2⁵⁶. Does not allocate.
char* writeNumber(double value, char* to);

}  // namespace ursula
