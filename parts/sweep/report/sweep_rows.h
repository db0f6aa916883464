#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "parts/sweep/sqlite.h"

namespace ursula {

/// Stores numbers that arrive by row and are read by column. More than `in_memory` numbers go to an unnamed temporary
/// file. Throws std::runtime_error if that cannot be written or read.
class ColumnStore {
 public:
  explicit ColumnStore(std::size_t columns, std::size_t in_memory = default_in_memory);

  void addRow(const std::vector<double>& row);
  /// Adds a column after the last row, as long as the others; returns its index.
  std::size_t addColumn(const std::vector<double>& values);

  std::size_t rows() const { return rows_; }
  std::vector<double> column(std::size_t which) const;

  static constexpr std::size_t default_in_memory = 6'000'000;

 private:
  struct Column {
    std::vector<double> recent;                                 ///< the last numbers
    std::vector<std::pair<std::int64_t, std::size_t>> earlier;  ///< places in the file, and counts
  };

  void count(std::size_t numbers);

  std::size_t in_memory_, recent_ = 0, rows_ = 0, width_;
  std::vector<Column> columns_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
};

/// One point with its results, as in the database.
struct SweepRow {
  struct Value {
    std::size_t name = 0;         ///< index into SweepRows::names()
    double value = 0, limit = 0;  ///< NaN if there is none
    std::string verdict;          ///< empty if there is none
  };
  std::int64_t id = 0;
  std::string verdict, error;
  std::vector<double> parameters;  ///< one per key, finite
  std::vector<Value> values;
};

/// Reads points by ascending id, one at a time, as they were at its construction, even if others write meanwhile. A
/// connection can have only one reader. Throws DatabaseError.
class SweepRows {
 public:
  SweepRows(Sqlite& database, const std::vector<std::string>& keys);

  /// Names of results, sorted by their bytes.
  const std::vector<std::string>& names() const { return names_; }
  bool next(SweepRow& row);

 private:
  void readParameters(SweepRow& row) const;
  std::size_t indexOf(const std::string& name) const;

  const std::vector<std::string>& keys_;
  std::shared_ptr<Sqlite> snapshot_;  ///< a read transaction, which outlives the statements
  std::vector<std::string> names_;
  Statement points_, results_;
  bool has_result_;
};

}  // namespace ursula
