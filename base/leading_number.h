#pragma once

#include <cstddef>
#include <string_view>

namespace ursula {

/// The number at the start of a text.
struct LeadingNumber {
  double value = 0;
  std::size_t length = 0;  ///< 0 if the text begins with no number or with one outside a double's range
};

/// Reads digits as in the C locale, because a host program may set one with decimal commas. A leading plus is accepted,
/// white space is not.
LeadingNumber leadingNumber(std::string_view text);

}  // namespace ursula
