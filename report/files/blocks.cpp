#include "report/files/blocks.h"

#include <fmt/format.h>
#include <algorithm>
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
  TimeSeries series = {};
  std::exception_ptr refusal = {};
  std::string text = {};
};

/// Any thread computes and formats blocks; groups of them are settled and written in order.
class Stream {
 public:
  Stream(const BlockTable& table, const StreamOptions& options, const Sink& sink)
      : table_(table), options_(options), sink_(sink) {}

  void run() {
    const std::size_t jobs = options_.jobs;
    for (std::size_t first = 0; first < table_.blocks; first += blocks_of_group * jobs) {
      blocks_.assign(std::min(blocks_of_group * jobs, table_.blocks - first), {});
      each([&](std::size_t i) { make(first + i, blocks_[i]); });
      for (Block& block : blocks_)
        if (!block.refusal && table_.settle) table_.settle(block.series);
      each([&](std::size_t i) { format(first + i, blocks_[i]); });
      for (std::size_t i = 0; i < blocks_.size(); ++i) write(first + i, blocks_[i]);
    }
  }

 private:
  /// So many blocks for each thread make its start cheap.
  static constexpr std::size_t blocks_of_group = 8;

  template <class Work>
  void each(const Work& work) {
    inParallel(options_.jobs, static_cast<int>(blocks_.size()), [&](int i) { work(i); });
  }

  /// An exception waits for the earlier blocks, so the reported one does not depend on timing.
  void make(std::size_t k, Block& block) const {
    try {
      block.series = table_.make(k);
    } catch (...) {
      block.refusal = std::current_exception();
    }
  }

  void format(std::size_t k, Block& block) const {
    if (block.refusal) return;
    if (k == 0) block.text = rowHeader(options_.format, block.series.names, table_.rows);
    appendRows(options_.format, block.series, block.text);
    block.series = {};
  }

  void write(std::size_t k, const Block& block) const {
    if (block.refusal) std::rethrow_exception(block.refusal);
    sink_(block.text);
    if (options_.written) options_.written(static_cast<double>(k + 1) / static_cast<double>(table_.blocks));
  }

  const BlockTable& table_;
  const StreamOptions& options_;
  const Sink& sink_;
  std::vector<Block> blocks_;
};

}  // namespace

void streamBlocks(const BlockTable& table, const StreamOptions& options, const Sink& sink) {
  Stream(table, options, sink).run();
}

}  // namespace ursula
