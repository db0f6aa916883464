#pragma once

#include <cstddef>

namespace ursula {

/// What writeNumber may write to, more than it returns.
constexpr std::size_t longest_number = 40;

/// Writes to `to` what {fmt} makes of "{:.17g}", byte by byte, and returns where it ends; `to` has room for
/// longest_number. Some five times as fast for sizes from 2⁻³⁶ to 2⁵⁶. Does not allocate.
char* writeNumber(double value, char* to);

}  // namespace ursula
