#include "report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace ursula::report {
namespace {

constexpr const char* replacement = "\xEF\xBF\xBD";  // U+FFFD

/// Removes U+FFFE and U+FFFF, which XML 1.0 forbids.
std::string validUtf8(const std::string& text) {
  using nlohmann::json;
  std::string out = json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
  for (const char* forbidden : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})
    for (std::size_t at = out.find(forbidden); at != std::string::npos; at = out.find(forbidden, at))
      out.replace(at, 3, replacement);
  return out;
}

std::string_view entity(const char& c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      break;
  }
  const bool forbidden = static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
  return forbidden ? std::string_view(replacement) : std::string_view(&c, 1);
}

bool unreserved(unsigned char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' ||
         c == '_' || c == '~' || c == '/';
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char& c : validUtf8(text)) result += entity(c);
  return result;
}

std::string urlPath(const std::string& path) {
  std::string result;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    result += unreserved(byte) ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return result;
}

std::string number(double value, int digits) {
  if (std::isnan(value)) return "none";
  if (std::isinf(value)) return value > 0 ? "infinite" : "−infinite";
  return fmt::format("{:.{}g}", value, digits);
}

std::string filled(std::string_view text, const std::vector<std::pair<std::string, std::string>>& values) {
  std::string result;
  for (std::size_t open = text.find("{{"); open != std::string_view::npos; open = text.find("{{")) {
    const std::size_t close = text.find("}}", open);
    if (close == std::string_view::npos) throw std::logic_error("template with an open {{");
    const std::string_view key = text.substr(open + 2, close - open - 2);
    const auto value =
        std::find_if(values.begin(), values.end(), [key](const auto& pair) { return pair.first == key; });
    if (value == values.end()) throw std::logic_error("template without a value for " + std::string(key));
    result.append(text.substr(0, open)).append(value->second);
    text.remove_prefix(close + 2);
  }
  return result.append(text);
}

}  // namespace ursula::report
