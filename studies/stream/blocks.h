#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "studies/stream/row_format.h"

namespace ursula {

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
