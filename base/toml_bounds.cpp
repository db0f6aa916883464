#include "base/toml_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>

namespace ursula {
namespace {

/// Scans a document character by character; it skips strings and comments as TOML does.
class BoundsScan {
 public:
  explicit BoundsScan(std::string_view text) : text_(text) {}

  void run() {
    while (at_ < text_.size()) {
      const char sign = text_[at_];
      if (sign == '"' || sign == '\'')
        passString(sign);
      else if (sign == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (isOfWord(sign))
        passWord();
      else
        passSign(sign);
    }
  }

 private:
  [[noreturn]] void refuse(std::size_t at, const std::string& what) const {
    throw TextRefusal(what, line_, at - line_start_ + 1);
  }

  void require(std::size_t count, std::size_t most, const char* what) const {
    if (count > most) refuse(at_, fmt::format("more than {0} {1}, expected at most {0}", most, what));
  }

  void newLine() {
    ++line_;
    line_start_ = at_ + 1;
    dots_ = 0;
  }

  void passSign(char sign) {
    if (sign != ' ' && sign != '\t' && sign != '\r' && sign != '\n') last_sign_ = sign;
    switch (sign) {
      case '\n':
        newLine();
        break;
      case '.':
        ++dots_;
        break;
      case '=':
        require(++keys_, most_toml_keys, "keys");
        dots_ = 0;
        break;
      case ',':
        require(++values_, most_toml_values, "values");
        dots_ = 0;
        break;
      case '[':
      case '{':
        ++brackets_;
        break;
      case ']':
      case '}':
        if (brackets_ > 0) --brackets_;
        dots_ = 0;
        break;
      default:
        break;
    }
    require(brackets_, most_toml_depth, "brackets in each other");
    require(dots_, most_toml_depth, "dots in a key");
    ++at_;
  }

  /// Returns whether keys and values may have the character outside of strings; dots are not among them.
  static bool isOfWord(char sign) {
    return (sign >= '0' && sign <= '9') || (sign >= 'a' && sign <= 'z') || (sign >= 'A' && sign <= 'Z') ||
           sign == '_' || sign == '-' || sign == '+';
  }

  /// Skips a word; a number is a word with at most one dot after a digit.
  void passWord() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && isOfWord(text_[at_])) ++at_;
    const bool is_value = last_sign_ == '=' || last_sign_ == '[' || last_sign_ == ',';  // keys may look like numbers
    last_sign_ = '\0';
    if (is_value && at_ < text_.size() && text_[at_] == '.') {
      ++at_;
      while (at_ < text_.size() && isOfWord(text_[at_])) ++at_;
    }
    if (is_value) requireInDouble(begin);
  }

  void requireInDouble(std::size_t begin) const {
    std::string digits(text_.substr(begin, at_ - begin));
    if (digits.find_first_of("eE") == std::string::npos || digits.rfind("0x", 0) == 0) return;
    digits.erase(std::remove(digits.begin(), digits.end(), '_'), digits.end());
    if (digits[0] == '+') digits.erase(0, 1);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::result_out_of_range && end == digits.data() + digits.size())
      refuse(begin, fmt::format("{}, expected a number that a double can hold, from 5e-324 to 1.8e308 in size",
                                digits.substr(0, 40)));
  }

  void passString(char quote) {
    last_sign_ = '\0';
    const bool is_long = text_.substr(at_, 3) == std::string(3, quote);
    at_ += is_long ? 3 : 1;
    while (at_ < text_.size()) {
      const char sign = text_[at_];
      if (sign == '\n') {
        if (!is_long) return;  // an error, which the parser finds
        newLine();
      }
      const std::size_t ends = std::min(text_.find_first_not_of(quote, at_), text_.size()) - at_;
      if (ends >= (is_long ? 3U : 1U)) {
        at_ += is_long ? ends : 1;
        return;
      }
      const bool escapes = sign == '\\' && quote == '"' && text_.substr(at_ + 1, 1) != "\n";
      at_ = std::min(at_ + (escapes ? 2 : 1), text_.size());
    }
  }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1, line_start_ = 0;
  char last_sign_ =
      '\0';  ///< character before the current one, ignoring blanks and comments; none after a word or a string
  std::size_t brackets_ = 0, dots_ = 0, keys_ = 0, values_ = 0;
};

}  // namespace

void requireBounded(std::string_view document) {
  if (document.size() > most_toml_bytes)
    throw TextRefusal(fmt::format("{} bytes, expected at most {}", document.size(), most_toml_bytes));
  BoundsScan(document).run();
}

}  // namespace ursula
