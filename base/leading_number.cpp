#include "base/leading_number.h"

#include <charconv>

namespace ursula {

LeadingNumber leadingNumber(std::string_view text) {
  const std::size_t plus = text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0;
  const char* const begin = text.data() + plus;
  LeadingNumber out;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), out.value);
  if (error == std::errc()) out.length = plus + static_cast<std::size_t>(end - begin);
  return out;
}

}  // namespace ursula
