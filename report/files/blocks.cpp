#include "report/files/blocks.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <cstdint>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "base/csv.h"
#include "base/start_threads.h"

namespace ursula {
namespace {

/// Aligns rows for vector loads if the file is mapped into memory.
constexpr std::size_t alignment = 64;

std::string jsonLine(const std::vector<std::string>& names, std::size_t rows) {
  std::string columns;
  for (const std::string& name : names) columns += (columns.empty() ? "\"" : ", \"") + name + "\"";
  const auto line = [&](std::size_t offset) {
    return fmt::format(R"({{"columns": [{}], "rows": {}, "dtype": "<f8", "offset": {:7}}})", columns, rows, offset);
  };
  const std::size_t least = line(0).size() + 1, offset = (least + alignment - 1) / alignment * alignment;
  std::string out = line(offset);
  out.resize(offset - 1, ' ');
  return out + '\n';
}

void putLittleEndian(double value, char* to) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  for (unsigned k = 0; k < sizeof(bits); ++k)
    to[k] = static_cast<char>(bits >> (8 * k));  // compiles to one store if possible
}

void appendBinary(const std::vector<std::vector<double>>& columns, std::string& out) {
  const std::size_t rows = columns.empty() ? 0 : columns.front().size(), before = out.size();
  out.resize(before + rows * columns.size() * sizeof(double));
  char* to = &out[before];
  for (std::size_t row = 0; row < rows; ++row)
    for (const std::vector<double>& column : columns) {
      putLittleEndian(column[row], to);
      to += sizeof(double);
    }
}

}  // namespace

std::string rowHeader(RowFormat format, const std::vector<std::string>& names, std::size_t rows) {
  return format == RowFormat::csv ? csvHeader(names) : jsonLine(names, rows);
}

void appendRows(RowFormat format, const TimeSeries& series, std::string& out) {
  if (format == RowFormat::csv)
    appendCsvRows(series.columns, out);
  else
    appendBinary(series.columns, out);
}

namespace {

struct Block {
  std::size_t k = 0;
  TimeSeries series = {};
  std::exception_ptr refusal = {};
  std::string text = {};
};
using BlockPointer = Block*;  // owned by the stream, because TBB drops items in flight after an exception

/// Blocks are created, settled and written in order; any thread computes and formats them.
class Stream {
 public:
  Stream(const BlockTable& table, const StreamOptions& options, const Sink& sink)
      : table_(table), options_(options), sink_(sink) {}

  void run() {
    using tbb::filter_mode;
    const auto chain = tbb::make_filter<void, BlockPointer>(
                           filter_mode::serial_in_order, [this](tbb::flow_control& control) { return next(control); }) &
                       tbb::make_filter<BlockPointer, BlockPointer>(
                           filter_mode::parallel, [this](BlockPointer block) { return make(block); }) &
                       tbb::make_filter<BlockPointer, BlockPointer>(
                           filter_mode::serial_in_order, [this](BlockPointer block) { return settle(block); }) &
                       tbb::make_filter<BlockPointer, BlockPointer>(
                           filter_mode::parallel, [this](BlockPointer block) { return format(block); }) &
                       tbb::make_filter<BlockPointer, void>(filter_mode::serial_in_order,
                                                            [this](BlockPointer block) { write(block); });
    // TBB aborts if the system gives fewer threads than it wants.
    const int jobs = 1 + static_cast<int>(threadsThatStart(static_cast<std::size_t>(options_.jobs - 1)));
    blocks_.resize(static_cast<std::size_t>(jobs) + 2);  // additional blocks wait for their turn
    // Allows the requested number of threads even on fewer processors, because TBB would otherwise warn.
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(jobs));
    tbb::task_arena arena(jobs);
    arena.execute([&] { tbb::parallel_pipeline(blocks_.size(), chain); });
  }

 private:
  BlockPointer next(tbb::flow_control& control) {
    if (next_ == table_.blocks) {
      control.stop();
      return nullptr;
    }
    Block& block = blocks_[next_ % blocks_.size()];  // its previous block has been written, because writing is in order
    block = {};
    block.k = next_++;
    return &block;
  }

  /// An exception waits for the earlier blocks, so the reported one does not depend on timing.
  BlockPointer make(BlockPointer block) const {
    try {
      block->series = table_.make(block->k);
    } catch (...) {
      block->refusal = std::current_exception();
    }
    return block;
  }

  BlockPointer settle(BlockPointer block) const {
    if (!block->refusal && table_.settle) table_.settle(block->series);
    return block;
  }

  BlockPointer format(BlockPointer block) const {
    if (block->refusal) return block;
    if (block->k == 0) block->text = rowHeader(options_.format, block->series.names, table_.rows);
    appendRows(options_.format, block->series, block->text);
    block->series = {};
    return block;
  }

  void write(BlockPointer block) const {
    if (block->refusal) std::rethrow_exception(block->refusal);
    sink_(block->text);
    if (options_.written) options_.written(static_cast<double>(block->k + 1) / static_cast<double>(table_.blocks));
  }

  const BlockTable& table_;
  const StreamOptions& options_;
  const Sink& sink_;
  std::vector<Block> blocks_;
  std::size_t next_ = 0;
};

}  // namespace

void streamBlocks(const BlockTable& table, const StreamOptions& options, const Sink& sink) {
  Stream(table, options, sink).run();
}

}  // namespace ursula
