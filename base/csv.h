#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/csv_dialect.h"
#include "base/errors.h"

namespace ursula {

/// Limits in bytes of a file and of a cell, beside most_csv_columns and most_csv_lines.
constexpr std::size_t most_csv_bytes = std::size_t{1} << 30, most_csv_cell = 1024;

/// `file:line: error: what, what was expected`
class CsvError : public InputError {
 public:
  using InputError::InputError;
};

/// A CSV of numbers: one header line, then rows. Every column has as many numbers as there are rows.
struct CsvTable {
  std::filesystem::path file;
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;   ///< one for each name
  std::vector<std::vector<int>> last_places;  ///< power of ten of the last digit printed: −2 of "1.50", 2 of "15e2"
  std::vector<int> lines;                     ///< 1-based line of each row in the file
  std::vector<std::string> ignored;           ///< names of the columns that were not wanted

  /// Returns the column of that name, or null if there is none.
  const std::vector<double>* find(const std::string& name) const;
  /// Returns the same, but throws CsvError if there is none; the message names the nearest column.
  const std::vector<double>& at(const std::string& name) const;
  std::size_t rows() const { return lines.size(); }
  /// Returns the place of a row, `file:line`, for the caller's own errors.
  std::string place(std::size_t row) const;
};

struct CsvOptions {
  std::function<bool(const std::string&)> wanted;  ///< selects columns by name; others are not parsed. Empty: all
  bool finite = true;                              ///< whether NaN, infinities and empty cells (NaN) are refused
  CsvDialect dialect = {};                         ///< how the file is written
};

/// Returns the whole file; throws CsvError if it cannot be read.
std::string readCsvText(const std::filesystem::path& file);

/// Reads a comma-separated file; accepts a byte order mark, CRLF and blanks around a cell. Throws CsvError for an
/// unreadable or empty file, unnamed or duplicate columns, missing or surplus cells, and non-numbers. With `finite` it
/// also refuses numbers that are not finite.
CsvTable readCsv(const std::filesystem::path& file, const CsvOptions& options = {});

/// Reads the same from a text; `file` names it in errors.
CsvTable parseCsv(const std::string& text, const std::filesystem::path& file, const CsvOptions& options = {});

/// How NaN is written.
enum class NanAs { word, empty_cell };

/// Returns one header line and the rows. Numbers have 17 significant digits, so reading them back gives the same
/// doubles. Throws std::invalid_argument unless there is one column for each name and all are equally long.
std::string csvText(const std::vector<std::string>& names, const std::vector<std::vector<double>>& columns,
                    NanAs nan = NanAs::word);

/// Passes the same text to `take` in pieces, because the text is several times larger than the table.
void csvPieces(const std::vector<std::string>& names, const std::vector<std::vector<double>>& columns, NanAs nan,
               const std::function<void(const std::string&)>& take);

/// Returns the header line: "t_s,p_x_m\n".
std::string csvHeader(const std::vector<std::string>& names);

/// Appends a text as a cell. It is quoted as in RFC 4180 if needed; terminal control characters are escaped.
void appendCsvCell(std::string_view text, std::string& out);

/// Appends a line for each row, as csvText writes it. All columns are equally long.
void appendCsvRows(const std::vector<std::vector<double>>& columns, std::string& out, NanAs nan = NanAs::word);

}  // namespace ursula
