#include "studies/sweep_report/column_store.h"

#include <algorithm>
#include <stdexcept>

namespace ursula {
namespace {

constexpr std::size_t chunk_rows = 4096;

}  // namespace

ColumnStore::ColumnStore(std::size_t columns, std::size_t in_memory)
    : left_in_memory_(in_memory), width_(columns), pending_(columns), chunks_(columns) {}

void ColumnStore::addRow(const std::vector<double>& row) {
  if (row.size() != width_ || chunks_.size() != width_) throw std::logic_error("a row of another width");
  ++rows_;
  for (std::size_t k = 0; k < row.size(); ++k) {
    pending_[k].push_back(row[k]);
    if (pending_[k].size() < chunk_rows) continue;
    keep(k, pending_[k].data(), chunk_rows);
    pending_[k].clear();
  }
}

std::size_t ColumnStore::addColumn(const std::vector<double>& values) {
  if (values.size() != rows_) throw std::logic_error("a column of another length");
  const std::size_t which = chunks_.size();
  chunks_.emplace_back();
  pending_.emplace_back();
  for (std::size_t from = 0; from < values.size(); from += chunk_rows)
    keep(which, values.data() + from, std::min(chunk_rows, values.size() - from));
  return which;
}

std::vector<double> ColumnStore::column(std::size_t which) const {
  std::vector<double> out;
  out.reserve(rows_);
  for (const Chunk& chunk : chunks_.at(which)) {
    if (!chunk.held.empty()) {
      out.insert(out.end(), chunk.held.begin(), chunk.held.end());
      continue;
    }
    const std::size_t from = out.size();
    out.resize(from + chunk.count);
    if (fseeko(file_.get(), chunk.place, SEEK_SET) != 0 ||
        std::fread(&out[from], sizeof(double), chunk.count, file_.get()) != chunk.count)
      throw std::runtime_error("error: a temporary file cannot be read");
  }
  out.insert(out.end(), pending_[which].begin(), pending_[which].end());
  return out;
}

void ColumnStore::keep(std::size_t column, const double* values, std::size_t count) {
  Chunk chunk;
  chunk.count = count;
  if (count <= left_in_memory_) {
    left_in_memory_ -= count;
    chunk.held.assign(values, values + count);
  } else {
    if (file_ == nullptr) file_.reset(std::tmpfile());
    chunk.place = end_;
    if (file_ == nullptr || fseeko(file_.get(), end_, SEEK_SET) != 0 ||
        std::fwrite(values, sizeof(double), count, file_.get()) != count)
      throw std::runtime_error("error: a temporary file cannot be written: is the disk full?");
    end_ += static_cast<std::int64_t>(count * sizeof(double));
  }
  chunks_[column].push_back(std::move(chunk));
}

}  // namespace ursula
