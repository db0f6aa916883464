#include "base/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "base/utf8.h"

namespace ursula {

LeadingNumber leadingNumber(std::string_view text) {
  const std::size_t plus = text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0;
  const char* const begin = text.data() + plus;
  LeadingNumber out;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), out.value);
  if (error == std::errc()) out.length = plus + (end - begin);
  return out;
}

std::optional<double> percentage(std::string_view text) {
  const LeadingNumber number = leadingNumber(text);
  const std::string_view rest = text.substr(number.length);
  return number.length > 0 && (rest == "%" || rest == " %") ? std::optional(number.value / 100) : std::nullopt;
}

namespace {

constexpr std::size_t longest = 100;

/// Returns the optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours cost 1
/// each.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, substitution});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t longer = std::max(word.size(), candidate.size());
    const std::size_t allowed = std::max<std::size_t>(1, longer / 3);
    // Words that differ so much are not misspelled, and long words would take too long.
    if (longer > longest || longer - std::min(word.size(), candidate.size()) > allowed) continue;
    const std::size_t far = distance(word, candidate);
    if (far > allowed || (!best.empty() && far >= least)) continue;
    best = candidate;
    least = far;
  }
  if (!best.empty()) return best;
  // "rpy" lacks the unit of "rpy_deg".
  const auto lacks_end = [&word](const std::string& candidate) { return candidate.rfind(word + "_", 0) == 0; };
  const auto longer = std::find_if(candidates.begin(), candidates.end(), lacks_end);
  return word.empty() || longer == candidates.end() ? "" : *longer;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string best = nearest(word, candidates);
  return best.empty() ? "" : ", did you mean '" + best + "'?";
}

std::string shellWord(const std::string& file) {
  const std::string name = !file.empty() && file[0] == '-' ? "./" + file : file;
  bool is_plain = !name.empty();
  std::string out = "'";
  for (const char c : name) {
    is_plain = is_plain &&
               (std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string("/._-+,").find(c) != std::string::npos);
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return is_plain ? name : out + "'";
}

namespace {

bool continues(unsigned char byte) { return (byte & 0xC0) == 0x80; }

/// Returns the length in bytes of the UTF-8 character at the start of `text`, or 0 if there is none; standard's table
/// 3-7.
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

/// Returns whether the character is C0, C1, DEL, or one of the line breaks and direction marks U+200E, U+200F, U+2028
/// to U+202E and U+2066 to U+2069.
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

std::string utf8(std::string text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = characterOf(std::string_view(text).substr(at));
    if (size == 0 && out.empty()) out.assign(text, 0, at);  // a text that is UTF-8 is not copied
    const auto byte = static_cast<unsigned char>(text[at]);
    if (size == 0)
      out.append(1, static_cast<char>(0xC0 | byte >> 6)).append(1, static_cast<char>(0x80 | (byte & 0x3F)));
    else if (!out.empty())
      out.append(text, at, size);
    at += std::max<std::size_t>(size, 1);
  }
  return out.empty() ? text : out;
}

std::string withoutControls(std::string_view text) { return escaped(text, "\n\t"); }

std::string shown(std::string_view text, std::size_t most) {
  if (text.size() <= most) return escaped(text, "");
  while (most > 0 && continues(static_cast<unsigned char>(text[most]))) --most;
  return escaped(text.substr(0, most), "") + " …";
}

std::string shownPath(std::string_view path) { return escaped(path, ""); }

}  // namespace ursula
