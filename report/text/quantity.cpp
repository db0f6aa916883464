#include "report/text/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <regex>
#include <utility>

#include "base/text.h"
#include "report/text/text.h"

namespace ursula::report {
namespace {

const std::string joined = "\u00A0";  // keeps a number and its unit on one line

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

std::string superscript(int exponent) {
  const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) out += digits[digit - '0'];
  return out;
}

bool takesPrefix(const std::string& unit) {
  const std::string first = unit.substr(0, unit.find_first_of("·/ "));
  return first == "m" || first == "N" || first == "J" || first == "rad" || first == "s" || first == "W";
}

double roundedTo(double value, int digits) { return leadingNumber(fmt::format("{:.{}e}", value, digits - 1)).value; }

/// The power of a thousand of the prefix that suits the value; none for units and sizes without one.
std::optional<int> prefixOf(double value, const std::string& pretty, int digits) {
  if (!takesPrefix(pretty) || value == 0 || !std::isfinite(value)) return std::nullopt;
  // Uses the rounded value: 999.96 is 1.00 k.
  const double shown = std::abs(roundedTo(value, digits));
  const int thousands = static_cast<int>(std::floor(std::log10(shown) / 3 + 1e-9));
  const bool small = pretty == "rad" || pretty == "s" || pretty.find("rad/") == 0;  // no kilo and larger prefixes
  if (thousands < -5 || thousands > 3) return std::nullopt;
  return std::min(thousands, small ? 0 : 3);
}

/// Rounds to `digits`, without an exponent if the text is short.
std::string rounded(double value, int digits) {
  const std::string text = fmt::format("{:.{}g}", value, digits);
  return text.find('e') == std::string::npos ? text : fmt::format("{:.0f}", leadingNumber(text).value);
}

}  // namespace

std::string prettyUnit(const std::string& unit) {
  const std::pair<const char*, const char*> columns[] = {
      {"Nm", "N·m"}, {"m_s2", "m/s²"}, {"m_s", "m/s"}, {"rad_s2", "rad/s²"}, {"rad_s", "rad/s"}};
  for (const auto& [from, to] : columns)
    if (unit == from) return to;
  return replaced(replaced(unit, "N m", "N·m"), "^2", "²");
}

std::string quantity(double value, const std::string& unit, int digits) {
  const auto [size, pretty] = prefixed(value, unit, digits);
  const std::string end = pretty.empty() ? "" : joined + pretty;
  if (!std::isfinite(value)) return number(value);
  const std::optional<int> prefix = prefixOf(value, prettyUnit(unit), digits);
  return (prefix ? rounded(roundedTo(value, digits) / size, digits) : plainNumber(value, digits)) + end;
}

std::pair<double, std::string> prefixed(double value, const std::string& unit, int digits) {
  const std::array<const char*, 9> prefixes = {"f", "p", "n", "µ", "m", "", "k", "M", "G"};
  const std::string pretty = prettyUnit(unit);
  const int used = prefixOf(value, pretty, digits).value_or(0);
  return {std::pow(1000.0, used), prefixes[used + 5] + pretty};
}

std::string SideBySide::text(std::size_t k) const { return numbers[k] + (unit.empty() ? "" : joined + unit); }

SideBySide sideBySide(const std::vector<double>& values, const std::string& unit, int digits) {
  double largest = 0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  const std::pair<double, std::string> in = prefixed(largest, unit, digits);
  const double size = in.first;
  SideBySide out{{}, in.second};
  const double shown = roundedTo(largest, digits) / size;
  const bool is_plain = shown == 0 || (shown >= 1e-3 && shown < 1e6);
  int decimals = shown == 0 ? 0 : std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(shown) + 1e-9)));
  const auto fixed = [&](double value) { return fmt::format("{:.{}f}", value / size, decimals); };
  const auto endsInZero = [&](double value) { return !std::isfinite(value) || fixed(value).back() == '0'; };
  while (decimals > 0 && std::all_of(values.begin(), values.end(), endsInZero)) --decimals;
  for (const double value : values) {
    const bool is_zero = std::abs(value / size) < 0.5 * std::pow(10.0, -decimals);
    out.numbers.push_back(!std::isfinite(value) ? number(value)
                          : is_zero             ? "0"
                          : is_plain            ? fixed(value)
                                                : plainNumber(value / size, digits));
  }
  return out;
}

std::string plainNumber(double value, int digits) {
  if (!std::isfinite(value)) return number(value);
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 1e-3 && size < 99999.5) return rounded(value, digits);
  return powersInPrint(fmt::format("{:.{}e}", value, digits - 1));
}

std::string powersInPrint(const std::string& text) {
  static const std::regex power("(\\d+)(?:\\.0+|(\\.\\d*[1-9])0*)?e([+-]?\\d+)");
  std::string out;
  std::ptrdiff_t from = 0;
  for (std::sregex_iterator at(text.begin(), text.end(), power), none; at != none; ++at) {
    const std::string mantissa = (*at)[1].str() + (*at)[2].str();
    out += text.substr(from, at->position() - from);
    out += (mantissa == "1" ? "" : mantissa + joined + "×" + joined) + "10" + superscript(std::stoi((*at)[3]));
    from = at->position() + at->length();
  }
  return out + text.substr(from);
}

namespace {

bool isUnit(std::string word) {
  static const std::regex unit(
      "(%|°|px|(f|p|n|µ|m|k|M|G)?(m|s|N|rad|g|J|W|A|V|Hz|lbf|ozf|kgf)((·|\\*|/)[A-Za-z].*|²|³)?)");
  while (!word.empty() && std::string_view(",.;:)").find(word.back()) != std::string_view::npos) word.pop_back();
  return std::regex_match(word, unit);
}

bool endsInDigit(const std::string& word) {
  static const std::regex number("(.*[0-9]|.*(⁰|¹|²|³|⁴|⁵|⁶|⁷|⁸|⁹)|∞)");
  return std::regex_match(word, number);
}

bool isSign(const std::string& word) { return word == "=" || word == "±" || word == "×"; }

}  // namespace

std::string unbroken(const std::string& text) {
  static const std::regex minus("(^|[ (\\[])-(?=[0-9])");
  std::string plain = powersInPrint(text);
  for (const auto& [from, to] : {std::pair("^2", "²"), {" +- ", " ± "}, {"N m", "N·m"}})
    plain = replaced(plain, from, to);
  plain = std::regex_replace(plain, minus, "$1−");
  const auto isKey = [](const std::string& word) {
    return word.find_first_of("._]") != std::string::npos || word.size() > 3;
  };
  std::string out, last, before;
  for (std::size_t from = 0; from <= plain.size();) {
    const std::size_t to = std::min(plain.find(' ', from), plain.size());
    const std::string word = plain.substr(from, to - from);
    // A key and its value are copied into a scenario, where only plain spaces are allowed.
    const bool assigns = (word == "=" && isKey(last)) || (last == "=" && isKey(before));
    const bool together = !assigns && ((endsInDigit(last) && isUnit(word)) || isSign(word) || isSign(last));
    out += (from == 0 ? "" : together ? joined : " ") + word;
    before = last;
    last = word;
    from = to + 1;
  }
  return out;
}

std::string formulaInPrint(const std::string& text) {
  static const std::regex eps("\\beps\\b");
  std::string out = std::regex_replace(powersInPrint(text), eps, "ε");
  for (const auto& [from, to] : {std::pair("kappa(", "κ("),
                                 {" x ", " × "},
                                 {"||", "‖"},
                                 {"inv(I)", "I⁻¹"},
                                 {"|T|'", "|T|ᵀ"},
                                 {"^2", "²"},
                                 {" +- ", " ± "}})
    out = replaced(out, from, to);
  return out;
}

std::string percentText(double share) {
  return share < 0.1 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}

int digitsToTell(double low, double high) {
  constexpr int fewest = 4, most = 15;
  const double ratio = std::max(std::abs(low), std::abs(high)) / (high - low);
  if (!(ratio > 1) || !std::isfinite(ratio)) return fewest;
  return std::clamp(static_cast<int>(std::ceil(std::log10(ratio))) + 2, fewest, most);
}

std::string inWords(int count) {
  const char* const words[] = {"no",    "one",   "two",  "three", "four",   "five",  "six",
                               "seven", "eight", "nine", "ten",   "eleven", "twelve"};
  return count >= 0 && count <= 12 ? words[count] : std::to_string(count);
}

}  // namespace ursula::report
