#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

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
  struct Chunk {
    std::vector<double> held;  ///< empty if it is in the file
    std::int64_t place = 0;
    std::size_t count = 0;
  };

  void keep(std::size_t column, const double* values, std::size_t count);

  std::size_t left_in_memory_;
  std::size_t rows_ = 0, width_;
  std::vector<std::vector<double>> pending_;  ///< rows of an incomplete chunk
  std::vector<std::vector<Chunk>> chunks_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
  std::int64_t end_ = 0;  ///< end of the file
};

}  // namespace ursula
