#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/csv_dialect.h"

namespace ursula {

/// What a file may hold beside most_csv_columns and most_csv_lines, in bytes: in all, and in a cell.
constexpr std::size_t most_csv_bytes = std::size_t{1} << 30, most_csv_cell = 1024;

/// `file:line: error: what, what was expected`
class CsvError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A CSV of numbers: one header line, then rows. Every column has as many numbers as there are rows.
struct CsvTable {
  std::filesystem::path file;
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;   ///< one for each name
  std::vector<std::vector<int>> last_places;  ///< power of ten of the last digit printed: −2 of "1.50", 2 of "15e2"
  std::vector<int> lines;                     ///< 1-based line of each row in the file
  std::vector<std::string> ignored;           ///< names of the columns that were not wanted

  /// The column of that name, or null where there is none.
  const std::vector<double>* find(const std::string& name) const;
  /// The same; throws CsvError naming the missing column, and the nearest of those that are there.
  const std::vector<double>& at(const std::string& name) const;
  std::size_t rows() const { return lines.size(); }
  /// The place of a row for an error of the caller's own: `file:line`.
  std::string place(std::size_t row) const;
};

struct CsvOptions {
  std::function<bool(const std::string&)> wanted;  ///< by name; cells of other columns are not looked at. Empty: all
  bool finite = true;                              ///< whether NaN, infinities and empty cells (NaN) are refused
  CsvDialect dialect = {};                         ///< how the file is written
};

/// All of a file; throws CsvError where it cannot be read.
std::string readCsvText(const std::filesystem::path& file);

/// Reads a comma-separated file; a byte order mark, CRLF and blanks around a cell are tolerated. Throws CsvError for an
/// unreadable or empty file, unnamed or duplicate columns, missing or surplus cells and anything but (finite) numbers.
CsvTable readCsv(const std::filesystem::path& file, const CsvOptions& options = {});

/// The same from text; `file` names it in errors.
CsvTable parseCsv(const std::string& text, const std::filesystem::path& file, const CsvOptions& options = {});

/// How NaN is written.
enum class NanAs { word, empty_cell };

/// One header line and the rows, numbers with 17 significant digits, so that reading them back gives the same doubles.
/// Throws std::invalid_argument unless there is one column for each name and all are equally long.
std::string csvText(const std::vector<std::string>& names, const std::vector<std::vector<double>>& columns,
                    NanAs nan = NanAs::word);

/// The same, piece by piece to `take`: a long table's text is several times as large as the table.
void csvPieces(const std::vector<std::string>& names, const std::vector<std::vector<double>>& columns, NanAs nan,
               const std::function<void(const std::string&)>& take);

}  // namespace ursula
