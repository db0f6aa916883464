#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "studies/stream/row_format.h"

namespace ursula {

/// A table that is made and written block by block, so that no more than a few blocks are ever in memory.
struct BlockTable {
  std::size_t blocks = 0;  ///< at least one
  std::size_t rows = 0;    ///< in all of them

  /// Block k; called by any thread, in any order. The same columns in each.
  std::function<TimeSeries(std::size_t k)> make;
  /// Called for one block after the other, in order, before it is written; may change it. Empty: nothing.
  std::function<void(TimeSeries& block)> settle = {};
};

/// Where bytes go, in order.
using Sink = std::function<void(std::string_view)>;

struct StreamOptions {
  RowFormat format = RowFormat::csv;
  int jobs = 1;                                    ///< threads, the calling one among them
  std::function<void(double share)> written = {};  ///< after each block; from any thread, one at a time
};

/// The bytes are the same for any number of jobs. Throws what `make` throws for the first block that it throws for,
/// after the blocks before it were written, and what the sink throws.
void streamBlocks(const BlockTable& table, const StreamOptions& options, const Sink& sink);

}  // namespace ursula
