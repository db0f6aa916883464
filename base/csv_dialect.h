#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ursula {

/// How a table of numbers is written. The default is the program's own: a header line, commas between, points inside.
struct CsvDialect {
  char separator = ',';                        ///< ' ' for runs of blanks
  bool decimal_comma = false;                  ///< "0,5" is a half
  bool comments = false;                       ///< lines that begin with # or % are passed over
  int header = 1;                              ///< its 1-based line; 0: there is none
  std::vector<std::string> header_cells = {};  ///< of that line; "1", "2", … where there is none

  bool isOwn() const { return separator == ',' && !comments && header == 1; }
  /// "';' between, decimal commas, the header in line 3, after #"; empty for the program's own.
  std::string words() const;
};

/// A cell without blanks around it.
std::string_view trimmedCell(std::string_view cell);

/// Of a file; and cells of a line.
constexpr std::size_t most_csv_columns = 20'000, most_csv_lines = 10'000'000;

/// The cells of a line without blanks around them and, in names, without quotes. Of more than most_csv_columns only one
/// more.
std::vector<std::string_view> splitCells(std::string_view line, char separator);

/// Lines without their ends (LF or CRLF), without a byte order mark and without blank lines at the end; the first
/// `most` of them.
std::vector<std::string_view> splitLines(std::string_view text, std::size_t most = most_csv_lines + 1);

/// Whether a line holds no row: blank, or a comment where the dialect has such.
bool isPassedOver(std::string_view line, const CsvDialect& dialect);

/// How `text` is written, from its header and its first rows. A tab, a semicolon or a comma in the header separates;
/// without one, blanks do. Commas inside numbers are decimal commas where something else separates, no number has a
/// point, and they cannot all be marks of thousands; else throws CsvError with a number that may be either. A header
/// may follow # or %, as NumPy writes it. A column of row numbers without a name is called "(row)". Throws CsvError for
/// UTF-16.
CsvDialect guessDialect(const std::string& text, const std::filesystem::path& file);

}  // namespace ursula
