#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ursula::report {

/// `text` for the content or a quoted attribute of HTML and XML: the five markup characters escaped; bytes that are not
/// UTF-8 and control characters that XML 1.0 forbids replaced by U+FFFD.
std::string escaped(const std::string& text);

/// A relative path for `href`: every byte outside unreserved characters and `/` percent-encoded.
std::string urlPath(const std::string& path);

/// For people: `digits` significant digits; words where the number is not finite.
std::string number(double value, int digits = 3);

/// `text` with every `{{key}}` replaced by its value, which is not searched again. Throws std::logic_error for a key
/// that has no value.
std::string filled(std::string_view text, const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace ursula::report
