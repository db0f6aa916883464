#include "base/csv.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <unordered_set>

#include "base/csv_digits.h"
#include "base/text.h"
#include "base/text_source.h"
#include "base/utf8.h"

namespace ursula {
namespace {

constexpr TextBounds csv_bounds{most_csv_bytes, "a CSV file"};

[[noreturn]] void fail(const std::filesystem::path& file, int line, const std::string& what) {
  throw CsvError(fmt::format("{}:{}: error: {}", shownPath(file.string()), line, what));
}

void requireShort(std::string_view cell, const std::filesystem::path& file, int line) {
  if (cell.size() > most_csv_cell)
    fail(file, line,
         fmt::format("a cell of {} bytes, '{}', expected at most {}", cell.size(), shown(cell), most_csv_cell));
}

/// Returns the indices of the wanted columns among all.
std::vector<std::size_t> readHeader(const std::vector<std::string>& cells, const CsvOptions& options, CsvTable& table) {
  const int line = std::max(1, options.dialect.header);
  std::vector<std::size_t> wanted;
  std::unordered_set<std::string_view> known;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string& name = cells[i];
    requireShort(name, table.file, line);
    if (name.empty()) fail(table.file, line, "a column without a name, expected quantity_index_unit in each");
    if (!known.insert(name).second)
      fail(table.file, line, "duplicate column '" + shown(name) + "', expected each name once");
    const bool is_wanted = !options.wanted || options.wanted(name);
    (is_wanted ? table.names : table.ignored).push_back(name);
    if (is_wanted) wanted.push_back(i);
  }
  table.columns.resize(wanted.size());
  table.last_places.resize(wanted.size());
  return wanted;
}

/// Reads by std::from_chars, because it ignores the locale. It refuses a leading plus, which is harmless and therefore
/// removed.
double readNumber(std::string_view cell, const CsvTable& table, bool finite, int line, const std::string& column) {
  if (cell.empty() && !finite) return std::nan("");
  std::string_view digits = cell;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc() && end == digits.data() + digits.size() && (!finite || std::isfinite(value))) return value;
  const std::string given = cell.empty() ? "an empty cell" : "'" + shown(cell) + "'";
  const bool is_beyond = error == std::errc::result_out_of_range && end == digits.data() + digits.size();
  const std::string expected = is_beyond ? "a number that a double can hold, from 5e-324 to 1.8e308 in size"
                               : finite  ? "a finite number"
                                         : "a number";
  fail(table.file, line, fmt::format("{} in column '{}', expected {}", given, shown(column), expected));
}

void readRow(std::string_view text, int line, const std::vector<std::size_t>& wanted, const CsvOptions& options,
             CsvTable& table) {
  const std::vector<std::string_view> cells = splitCells(text, options.dialect.separator);
  const std::size_t width = table.names.size() + table.ignored.size();
  if (cells.size() != width)
    fail(table.file, line,
         fmt::format(
             "{} cell{}, expected {}, one for each column of the header{}", cells.size(), cells.size() == 1 ? "" : "s",
             width,
             options.dialect.separator == ',' && width > 2 && cells.size() + 1 >= 2 * width && cells.size() <= 2 * width
                 ? "; with decimal commas, separate the values by ';'"
                 : ""));
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    requireShort(cells[wanted[i]], table.file, line);
    std::string cell(cells[wanted[i]]);
    if (options.dialect.decimal_comma) std::replace(cell.begin(), cell.end(), ',', '.');
    table.columns[i].push_back(readNumber(cell, table, options.finite, line, table.names[i]));
    table.last_places[i].push_back(std::isfinite(table.columns[i].back()) ? lastPlace(cell) : 0);
  }
  table.lines.push_back(line);
}

/// Returns whether two names differ in their index alone, like p_x_m and p_y_m. One is never a misspelling of the
/// other.
bool areSiblings(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin());
  if (in_a == a.end() || !std::equal(in_a + 1, a.end(), in_b + 1)) return false;
  const bool alone_before = in_a == a.begin() || *(in_a - 1) == '_';
  return alone_before && (in_a + 1 == a.end() || *(in_a + 1) == '_');
}

}  // namespace

const std::vector<double>* CsvTable::find(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &columns[found - names.begin()];
}

const std::vector<double>& CsvTable::at(const std::string& name) const {
  if (const std::vector<double>* column = find(name)) return *column;
  std::vector<std::string> candidates;
  for (const auto* some : {&names, &ignored})
    std::copy_if(some->begin(), some->end(), std::back_inserter(candidates),
                 [&](const std::string& other) { return !areSiblings(name, other); });
  fail(file, 1, "missing column '" + name + "', expected it in the header" + didYouMean(name, candidates));
}

std::string CsvTable::place(std::size_t row) const {
  return fmt::format("{}:{}", shownPath(file.string()), lines.at(row));
}

CsvTable parseCsv(const std::string& text, const std::filesystem::path& file, const CsvOptions& options) {
  CsvTable table;
  table.file = file;
  const std::vector<std::string_view> lines = splitLines(text);
  if (lines.size() > most_csv_lines)
    fail(file, static_cast<int>(most_csv_lines) + 1,
         fmt::format("more than {0} lines, expected at most {0}", most_csv_lines));
  if (lines.empty()) fail(file, 1, "an empty file, expected a header line and rows of numbers");
  std::vector<std::string> names = options.dialect.header_cells;
  if (names.empty())
    for (std::string_view cell : splitCells(lines.front(), ',')) names.emplace_back(cell);
  if (names.size() > most_csv_columns)
    fail(file, std::max(1, options.dialect.header),
         fmt::format("more than {0} columns, expected at most {0}", most_csv_columns));
  const std::vector<std::size_t> wanted = readHeader(names, options, table);
  for (std::size_t i = options.dialect.header; i < lines.size(); ++i)
    if (!isPassedOver(lines[i], options.dialect)) readRow(lines[i], static_cast<int>(i) + 1, wanted, options, table);
  if (table.lines.empty()) fail(file, 1, "no rows, expected at least one below the header");
  return table;
}

std::string readCsvText(const std::filesystem::path& file) {
  try {
    return utf8(readText(file, csv_bounds));
  } catch (const TextRefusal& refusal) {
    const std::string place = refusal.line > 0 ? fmt::format(":{}", refusal.line) : "";
    throw CsvError(fmt::format("{}{}: error: {}", shownPath(file.string()), place, refusal.what()));
  }
}

CsvTable readCsv(const std::filesystem::path& file, const CsvOptions& options) {
  return parseCsv(readCsvText(file), file, options);
}

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

int lastPlace(std::string_view cell) {
  const auto e = cell.find_first_of("eE");
  const std::string_view mantissa = cell.substr(0, e);
  const auto point = mantissa.find('.');
  const int decimals = point == std::string_view::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
  int exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view digits = cell.substr(e + 1);
    if (digits[0] == '+') digits.remove_prefix(1);
    if (std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec != std::errc()) exponent = 0;
  }
  return std::clamp(exponent, -400, 400) - decimals;
}

std::string csvText(const std::vector<std::string>& names, const std::vector<std::vector<double>>& columns, NanAs nan) {
  std::string out;
  csvPieces(names, columns, nan, [&out](const std::string& piece) { out += piece; });
  return out;
}

}  // namespace ursula
