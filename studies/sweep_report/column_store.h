#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

namespace ursula {

/// Numbers that come row by row and are wanted column by column. What is more than `in_memory` numbers goes into a
/// temporary file without a name. Throws std::runtime_error where that cannot be written or read.
class ColumnStore {
 public:
  explicit ColumnStore(std::size_t columns, std::size_t in_memory = default_in_memory);

  void addRow(const std::vector<double>& row);
  /// After the last row: a further column, as long as the others; returns its index.
  std::size_t addColumn(const std::vector<double>& values);

  std::size_t rows() const { return rows_; }
  std::vector<double> column(std::size_t which) const;

  static constexpr std::size_t default_in_memory = 6'000'000;

 private:
  struct Chunk {
    std::vector<double> held;  ///< empty where it is in the file
    std::int64_t place = 0;
    std::size_t count = 0;
  };

  void keep(std::size_t column, const double* values, std::size_t count);

  std::size_t left_in_memory_;
  std::size_t rows_ = 0, width_;
  std::vector<std::vector<double>> pending_;  ///< rows that fill no chunk yet
  std::vector<std::vector<Chunk>> chunks_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
  std::int64_t end_ = 0;  ///< of the file
};

}  // namespace ursula
