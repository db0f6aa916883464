#include "base/csv_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/number_text.h"
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

void appendCsvRows(const std::vector<std::vector<double>>& columns, std::string& out, NanAs nan) {
  const std::size_t rows = columns.empty() ? 0 : columns.front().size();
  constexpr std::size_t usual = 21;  // 17 digits, a sign, a point, "0." or the like, and a comma
  out.reserve(out.size() + rows * columns.size() * usual + columns.size() * longest_number);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t before = out.size();
    out.resize(before + columns.size() * (longest_number + 1));
    char* to = &out[before];
    for (const std::vector<double>& column : columns) {
      const double value = column[row];
      if (nan == NanAs::word || !std::isnan(value)) to = writeNumber(value, to);
      *to++ = ',';
    }
    to[-1] = '\n';
    out.resize(static_cast<std::size_t>(to - out.data()));
  }
}

std::string csvText(const std::vector<std::string>& names, const std::vector<std::vector<double>>& columns, NanAs nan) {
  if (names.empty() || names.size() != columns.size()) throw std::invalid_argument("csvText: one column for each name");
  for (const auto& column : columns)
    if (column.size() != columns.front().size()) throw std::invalid_argument("csvText: columns of unequal length");
  std::string out = csvHeader(names);
  appendCsvRows(columns, out, nan);
  return out;
}

}  // namespace ursula
