#include "base/shown_text.h"

namespace ursula {
namespace {

bool continues(unsigned char byte) { return (byte & 0xC0) == 0x80; }

/// The length in bytes of the UTF-8 character at the start of `text`, or 0 if there is none; standard's table 3-7.
std::size_t characterOf(std::string_view text) {
  const auto byte = [text](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t size = first >= 0xC2 && first < 0xE0   ? 2
                           : (first & 0xF0) == 0xE0        ? 3
                           : first >= 0xF0 && first < 0xF5 ? 4
                                                           : 0;
  if (size == 0 || text.size() < size) return 0;
  for (std::size_t k = 1; k < size; ++k)
    if (!continues(byte(k))) return 0;
  const unsigned char second = byte(1);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool beyond = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return overlong || beyond ? 0 : size;
}

/// C0, C1, DEL, and the line breaks and direction marks U+200E, U+200F, U+2028 to U+202E and U+2066 to U+2069.
bool isControl(std::string_view character) {
  const auto byte = [character](std::size_t k) { return static_cast<unsigned char>(character[k]); };
  if (byte(0) < 0x20 || byte(0) == 0x7F || (byte(0) == 0xC2 && byte(1) < 0xA0)) return true;
  if (byte(0) != 0xE2) return false;
  return (byte(1) == 0x80 && (byte(2) == 0x8E || byte(2) == 0x8F || (byte(2) >= 0xA8 && byte(2) <= 0xAE))) ||
         (byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9);
}

std::string escaped(std::string_view text, std::string_view kept) {
  static constexpr const char* digits = "0123456789abcdef";
  std::string out;
  while (!text.empty()) {
    const std::size_t size = characterOf(text);
    const std::string_view character = text.substr(0, size == 0 ? 1 : size);
    if (size > 0 && (!isControl(character) || kept.find(character[0]) != std::string_view::npos))
      out += character;
    else
      for (const char byte : character)
        out.append("\\x").append(1, digits[(byte >> 4) & 0xF]).append(1, digits[byte & 0xF]);
    text.remove_prefix(character.size());
  }
  return out;
}

}  // namespace

std::string withoutControls(std::string_view text) { return escaped(text, "\n\t"); }

std::string shown(std::string_view text, std::size_t most) {
  if (text.size() <= most) return escaped(text, "");
  while (most > 0 && continues(static_cast<unsigned char>(text[most]))) --most;
  return escaped(text.substr(0, most), "") + " …";
}

std::string shownPath(std::string_view path) { return escaped(path, ""); }

}  // namespace ursula
