#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ursula::report {

/// Escapes `text` for HTML and XML content or quoted attributes: the five markup characters. Bytes that
/// are not UTF-8 count as Latin-1; control characters that XML 1.0 forbids become U+FFFD.
std::string escaped(const std::string& text);

/// Returns a relative path for `href`: every byte except unreserved characters and `/` is percent-encoded.
std::string urlPath(const std::string& path);

/// Formats for people: `digits` significant digits; words if the number is not finite.
std::string number(double value, int digits = 3);

/// Returns the number of terminal columns of a UTF-8 text, one per character.
std::size_t columnsOf(const std::string& text);

enum class Align { left, right };

/// Pads `text` with spaces to `width` columns.
std::string padded(const std::string& text, std::size_t width, Align align = Align::left);

/// Formats cells by rows. Each column is as wide as its widest cell, with two spaces between and none at a line's end.
std::vector<std::string> alignedRows(const std::vector<std::vector<std::string>>& rows,
                                     const std::vector<Align>& columns);

/// Writes `head`, then `text` from column `margin` on, wrapped between words at 100 columns.
std::string wrapped(const std::string& head, std::size_t margin, const std::string& text);

/// Adds terminal escapes for the paint if `coloured`.
enum class Paint { good, bad, open, quiet, strong };
std::string painted(const std::string& text, Paint paint, bool coloured);

}  // namespace ursula::report
