#include "base/csv_dialect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/csv.h"

namespace ursula {
namespace {

/// Limits of the guess: rows, and lines including comments and blanks.
constexpr std::size_t rows_looked_at = 20, lines_looked_at = 10'000;

bool isComment(std::string_view line) {
  const std::string_view cell = trimmedCell(line);
  return !cell.empty() && (cell.front() == '#' || cell.front() == '%');
}

std::string_view withoutMark(std::string_view line) {
  line = trimmedCell(line);
  while (!line.empty() && (line.front() == '#' || line.front() == '%')) line.remove_prefix(1);
  return trimmedCell(line);
}

/// Returns whether a cell holds only digits, signs, points, commas and exponents, or "nan" or "inf".
bool looksNumeric(std::string_view cell) {
  if (cell == "nan" || cell == "inf" || cell == "-inf" || cell == "NaN") return true;
  return cell.find_first_of("0123456789") != std::string_view::npos &&
         cell.find_first_not_of("0123456789+-.,eE") == std::string_view::npos && cell.front() != 'e' &&
         cell.front() != 'E';
}

char separatorOf(std::string_view line) {
  for (char separator : {'\t', ';', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

/// Returns the separator of a row of numbers. A comma does not separate next to another separator or inside
/// blank-separated cells.
char separatorOfNumbers(std::string_view line) {
  for (char separator : {'\t', ';'})
    if (line.find(separator) != std::string_view::npos) return separator;
  if (line.find(',') == std::string_view::npos) return ' ';
  const std::vector<std::string_view> cells = splitCells(line, ',');
  const bool whole = std::none_of(cells.begin(), cells.end(), [](std::string_view cell) {
    return cell.find_first_of(" \t") != std::string_view::npos;  // in "0,5 1,2" the blank separates
  });
  return whole ? ',' : ' ';
}

bool isRow(std::string_view line) {
  const std::vector<std::string_view> cells = splitCells(line, separatorOfNumbers(line));
  return std::all_of(cells.begin(), cells.end(),
                     [](std::string_view cell) { return cell.empty() || looksNumeric(cell); });
}

/// The lines that say how the file is written.
struct Head {
  int header = 0;  ///< 1-based
  std::string_view names;
  std::vector<std::string_view> rows;
  std::string comments;
};

Head headOf(const std::vector<std::string_view>& lines) {
  Head head;
  int commented = 0;
  for (std::size_t i = 0; i < lines.size() && head.rows.size() < rows_looked_at; ++i) {
    if (isComment(lines[i])) {
      const char sign = trimmedCell(lines[i]).front();
      if (head.comments.find(sign) == std::string::npos) head.comments += sign;
      if (head.rows.empty() && head.header == 0) commented = static_cast<int>(i) + 1;
    } else if (trimmedCell(lines[i]).empty()) {
      continue;
    } else if (head.header == 0 && head.rows.empty() && !isRow(lines[i])) {
      head.header = static_cast<int>(i) + 1;
    } else {
      head.rows.push_back(lines[i]);
    }
  }
  if (head.header == 0) head.header = commented;
  if (head.header > 0) head.names = withoutMark(lines[head.header - 1]);
  return head;
}

/// Returns whether commas in numbers are decimal commas. Throws if they may also mark thousands.
bool hasDecimalCommas(const Head& head, char separator, const std::filesystem::path& file) {
  std::string_view either;
  bool certain = false;
  for (std::string_view row : head.rows)
    for (std::string_view cell : splitCells(row, separator)) {
      if (!looksNumeric(cell)) continue;
      if (cell.find('.') != std::string_view::npos) return false;
      const auto comma = cell.find(',');
      if (comma == std::string_view::npos) continue;
      either = cell;
      const auto first = cell.find_first_of("0123456789");
      const auto end = std::min(cell.find_first_of("eE"), cell.size());
      certain = certain || end - comma != 4 ||
                cell[first] == '0';  // thousands come in groups of three and never begin with 0
    }
  if (!either.empty() && !certain)
    throw CsvError(fmt::format("{}:{}: error: '{}' may be {} or {}, expected decimal points", file.string(),
                               head.header + 1, either, std::string(either).replace(either.find(','), 1, "."),
                               std::string(either).erase(either.find(','), 1)));
  return !either.empty();
}

/// Returns whether the first cells count rows.
bool beginWithRowNumbers(const Head& head, char separator) {
  const std::string first(head.rows.empty() ? "" : splitCells(head.rows.front(), separator).front());
  if (head.rows.size() < 2 || (first != "0" && first != "1")) return false;
  for (std::size_t k = 0; k < head.rows.size(); ++k)
    if (splitCells(head.rows[k], separator).front() != std::to_string(k + (first == "1" ? 1 : 0))) return false;
  return true;
}

std::vector<std::string> namesOf(const Head& head, char separator) {
  std::vector<std::string> names;
  const std::size_t width = head.rows.empty() ? 0 : splitCells(head.rows.front(), separator).size();
  if (head.header == 0) {
    for (std::size_t i = 1; i <= width; ++i) names.push_back(std::to_string(i));
    return names;
  }
  for (std::string_view cell : splitCells(head.names, separator)) names.emplace_back(cell);
  // A header after # may use another separator than its numbers; R omits the name of its row numbers.
  if (names.size() != width && !head.rows.empty() && separatorOf(head.names) != separator) {
    std::vector<std::string> others;
    for (std::string_view cell : splitCells(head.names, separatorOf(head.names))) others.emplace_back(cell);
    if (others.size() == width) names = others;
  }
  const bool rows_counted = beginWithRowNumbers(head, separator);
  if (rows_counted && names.size() + 1 == width) names.insert(names.begin(), "");
  if (rows_counted && names.size() > 1 && names.front().empty()) names.front() = "(row)";
  return names;
}

}  // namespace

std::string CsvDialect::words() const {
  if (isOwn()) return "";
  std::string out = separator == '\t'  ? "tabs between"
                    : separator == ' ' ? "blanks between"
                                       : fmt::format("'{}' between", separator);
  if (decimal_comma) out += ", decimal commas";
  if (header == 0) return out + ", no header";
  if (!comments.empty()) out += fmt::format(", lines after {} passed over", comments.size() > 1 ? "# or %" : comments);
  return header == 1 ? out : out + fmt::format(", the header in line {}", header);
}

std::string_view trimmedCell(std::string_view cell) {
  const auto first = cell.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return cell.substr(first, cell.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string_view> splitCells(std::string_view line, char separator) {
  const auto add = [](std::vector<std::string_view>& cells, std::string_view cell) {
    cell = trimmedCell(cell);
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    cells.push_back(cell);
  };
  if (separator == ' ') line = trimmedCell(line);
  std::vector<std::string_view> cells;
  for (;;) {
    const auto end = separator == ' ' ? line.find_first_of(" \t") : line.find(separator);
    add(cells, line.substr(0, end));
    if (end == std::string_view::npos || cells.size() > most_csv_columns) return cells;
    line.remove_prefix(end + 1);
    if (separator == ' ') line = trimmedCell(line);
  }
}

std::vector<std::string_view> splitLines(std::string_view text, std::size_t most) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  std::vector<std::string_view> lines;
  while (!text.empty() && lines.size() < most) {
    const auto end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  while (!lines.empty() && trimmedCell(lines.back()).empty()) lines.pop_back();
  return lines;
}

bool isPassedOver(std::string_view line, const CsvDialect& dialect) {
  return !dialect.comments.empty() && (isComment(line) || trimmedCell(line).empty());
}

CsvDialect guessDialect(const std::string& text, const std::filesystem::path& file) {
  const std::string_view start = std::string_view(text).substr(0, 2);
  if (start == "\xFF\xFE" || start == "\xFE\xFF")
    throw CsvError(fmt::format("{}:1: error: UTF-16, expected UTF-8 or plain text", file.string()));
  const Head head = headOf(splitLines(text, lines_looked_at));
  CsvDialect out;
  if (head.header == 0 && head.rows.empty()) return out;
  out.header = head.header;
  out.comments = head.comments;
  const bool by_header = head.rows.empty() || (head.header > 0 && head.comments.empty());
  out.separator = by_header ? separatorOf(head.names) : separatorOfNumbers(head.rows.front());
  out.decimal_comma = out.separator != ',' && hasDecimalCommas(head, out.separator, file);
  out.header_cells = namesOf(head, out.separator);
  return out;
}

}  // namespace ursula
