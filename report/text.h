#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ursula::report {

/// Escapes `text` for HTML and XML content or quoted attributes: the five markup characters. Invalid UTF-8 and control
/// characters that XML 1.0 forbids become U+FFFD.
std::string escaped(const std::string& text);

/// Returns a relative path for `href`: every byte except unreserved characters and `/` is percent-encoded.
std::string urlPath(const std::string& path);

/// Formats for people: `digits` significant digits; words if the number is not finite.
std::string number(double value, int digits = 3);

/// Replaces every `{{key}}` in `text` by its value, without searching the value again. Throws std::logic_error for a
/// key without a value.
std::string filled(std::string_view text, const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace ursula::report
