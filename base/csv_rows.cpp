#include "base/csv_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "base/shown_text.h"

namespace ursula {

std::string csvHeader(const std::vector<std::string>& names) { return fmt::format("{}\n", fmt::join(names, ",")); }

void appendCsvCell(std::string_view text, std::string& out) {
  const auto odd = [](unsigned char c) { return c < 0x20 || c > 0x7E; };
  const bool plain = std::none_of(text.begin(), text.end(), odd);
  const std::string safe = plain ? "" : withoutControls(text);
  if (!plain) text = safe;
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  out += '"';
}

namespace {

void appendRowsBetween(std::size_t from, std::size_t to_row, const std::vector<std::vector<double>>& columns, NanAs nan,
                       std::string& out) {
  constexpr std::size_t usual = 21;  // 17 digits, a sign, a point, "0." or similar, and a comma
  out.reserve(out.size() + (to_row - from) * columns.size() * usual);
  for (std::size_t row = from; row < to_row; ++row) {
    for (const std::vector<double>& column : columns) {
      const double value = column[row];
      if (nan == NanAs::word || !std::isnan(value)) fmt::format_to(std::back_inserter(out), "{}", value);
      out += ',';
    }
    out.back() = '\n';
  }
}

}  // namespace

void appendCsvRows(const std::vector<std::vector<double>>& columns, std::string& out, NanAs nan) {
  if (!columns.empty()) appendRowsBetween(0, columns.front().size(), columns, nan, out);
}

void csvPieces(const std::vector<std::string>& names, const std::vector<std::vector<double>>& columns, NanAs nan,
               const std::function<void(const std::string&)>& take) {
  if (names.empty() || names.size() != columns.size()) throw std::invalid_argument("csvText: one column for each name");
  for (const auto& column : columns)
    if (column.size() != columns.front().size()) throw std::invalid_argument("csvText: columns of unequal length");
  constexpr std::size_t numbers_at_once = 1 << 16;
  const std::size_t step = std::max<std::size_t>(1, numbers_at_once / columns.size()), rows = columns.front().size();
  std::string piece = csvHeader(names);
  for (std::size_t row = 0; row < rows; row += step) {
    appendRowsBetween(row, std::min(row + step, rows), columns, nan, piece);
    take(piece);
    piece.clear();
  }
  if (!piece.empty()) take(piece);
}

std::string csvText(const std::vector<std::string>& names, const std::vector<std::vector<double>>& columns, NanAs nan) {
  std::string out;
  csvPieces(names, columns, nan, [&out](const std::string& piece) { out += piece; });
  return out;
}

}  // namespace ursula
