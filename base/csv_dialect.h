#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ursula {

/// How a table of numbers is written. The default is this program's own form: header line, commas, decimal points.
struct CsvDialect {
  char separator = ',';                        ///< ' ' means runs of blanks
  bool decimal_comma = false;                  ///< "0,5" is a half
  std::string comments = {};                   ///< "#", "%" or both: met at lines that are skipped, as blank ones are
  int header = 1;                              ///< its 1-based line; 0 if there is none
  std::vector<std::string> header_cells = {};  ///< cells of that line; "1", "2", … if there is none

  bool isOwn() const { return separator == ',' && comments.empty() && header == 1; }
  /// Returns "';' between, decimal commas, lines after # passed over, the header in line 3"; empty for this program's
  /// own form.
  std::string words() const;
};

/// Returns a cell without blanks around it.
std::string_view trimmedCell(std::string_view cell);

/// Limits of a file; the columns are also those of a line.
constexpr std::size_t most_csv_columns = 20'000, most_csv_lines = 10'000'000;

/// Returns the cells of a line, without blanks around them and without the quotes of names. It stops one cell beyond
/// most_csv_columns.
std::vector<std::string_view> splitCells(std::string_view line, char separator);

/// Returns the first `most` lines, without line ends (LF or CRLF), byte order mark and blank lines at the end.
std::vector<std::string_view> splitLines(std::string_view text, std::size_t most = most_csv_lines + 1);

/// Returns whether a line holds no row: a comment or a blank line, if the dialect has comments.
bool isPassedOver(std::string_view line, const CsvDialect& dialect);

/// Guesses from header and first rows how `text` is written. A tab, a semicolon or a comma in the header separates;
/// without one, blanks do. Commas in numbers are decimal commas if something else separates and no number has a point.
/// If all commas may mark thousands, it throws CsvError with such a number. A header may follow # or %, as NumPy writes
/// it. An unnamed column of row numbers is called "(row)". Throws CsvError for UTF-16.
CsvDialect guessDialect(const std::string& text, const std::filesystem::path& file);

}  // namespace ursula
