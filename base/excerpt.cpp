#include "base/excerpt.h"

#include <algorithm>
#include <vector>

#include "base/shown_text.h"

namespace ursula {
namespace {

constexpr std::size_t most_before = 60, most_shown = 100;  // characters that fit in a terminal

/// Returns the UTF-8 characters of a line, with blanks for those that move the cursor.
std::vector<std::string> charactersOf(const std::string& line) {
  std::vector<std::string> out;
  for (const char byte : line) {
    const bool follows = (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
    if (follows && !out.empty())
      out.back() += byte;
    else
      out.emplace_back(1, static_cast<unsigned char>(byte) < 0x20 ? ' ' : byte);
  }
  return out;
}

}  // namespace

std::string excerptOf(const std::string& text, std::size_t line, std::size_t column) {
  std::size_t begin = 0;
  for (std::size_t k = 1; k < line; ++k) {
    begin = text.find('\n', begin);
    if (begin == std::string::npos) return "";
    ++begin;
  }
  const std::vector<std::string> all =
      charactersOf(text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin));
  const std::size_t at = std::min(std::max<std::size_t>(column, 1) - 1, all.size());
  const std::size_t from = at > most_before ? at - most_before : 0;
  std::string shown_line;
  for (std::size_t k = from; k < all.size() && k < from + most_shown; ++k) shown_line += all[k];
  const std::string number = std::to_string(line), gap(number.size() < 4 ? 4 - number.size() : 0, ' ');
  return gap + number + " | " + withoutControls(shown_line) + "\n" + std::string(gap.size() + number.size(), ' ') +
         " | " + std::string(at - from, ' ') + "^";
}

}  // namespace ursula
