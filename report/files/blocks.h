#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "validation/verdict/result.h"

namespace ursula {

/// Formats of rows. `csv` is a header line, then numbers with 17 significant digits. `binary` is one line of JSON with
/// `columns`, `rows`, `dtype` ("<f8") and `offset` (the length of the line in bytes, a multiple of 64), then the rows
/// as consecutive little-endian doubles.
enum class RowFormat { csv, binary };

/// Returns the text before the rows.
std::string rowHeader(RowFormat format, const std::vector<std::string>& names, std::size_t rows);

/// Appends the rows of `series` to `out`.
void appendRows(RowFormat format, const TimeSeries& series, std::string& out);

/// A table that is computed and written in blocks, so that only a few blocks are in memory.
struct BlockTable {
  std::size_t blocks = 0;  ///< at least one
  std::size_t rows = 0;    ///< in all blocks together

  /// Computes block k; any thread may call it, in any order. All blocks have the same columns.
  std::function<TimeSeries(std::size_t k)> make;
  /// Called for the blocks in order before they are written; may change them. May be empty.
  std::function<void(TimeSeries& block)> settle = {};
};

/// Receives the bytes in order.
using Sink = std::function<void(std::string_view)>;

struct StreamOptions {
  RowFormat format = RowFormat::csv;
  int jobs = 1;                                    ///< number of threads, including the caller
  std::function<void(double share)> written = {};  ///< called after each block from any thread, without overlap
};

/// The bytes do not depend on the number of jobs. Rethrows the exception of `make` for the first failed block, after
/// the blocks before it were written, and the sink's exceptions.
void streamBlocks(const BlockTable& table, const StreamOptions& options, const Sink& sink);

}  // namespace ursula
