#include "studies/sweep_report/sweep_rows.h"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/text.h"
#include "studies/sweep/sweep_database.h"

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

namespace {

bool isOfName(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
}

std::vector<std::string> namesIn(Sqlite& database) {
  std::vector<std::string> names;
  for (Statement each(database, "SELECT DISTINCT name FROM result ORDER BY name"); each.step();) {
    names.push_back(each.text(0));
    if (!std::all_of(names.back().begin(), names.back().end(), isOfName))
      throw DatabaseError(fmt::format("{}: error: '{}' is not a name of a result: the database is damaged",
                                      database.file().string(), shown(names.back())));
  }
  return names;
}

}  // namespace

SweepRows::SweepRows(Sqlite& database, const std::vector<std::string>& keys)
    : database_(database),
      keys_(keys),
      snapshot_(database),
      names_(namesIn(database)),
      points_(database, "SELECT id, parameters, verdict, error FROM point ORDER BY id"),
      results_(database, "SELECT point, name, value, \"limit\", verdict FROM result ORDER BY point, name"),
      has_result_(results_.step()) {
  for (std::size_t k = 0; k < names_.size(); ++k) places_.emplace(names_[k], k);
}

SweepRows::Snapshot::~Snapshot() {
  try {
    database_.run("COMMIT");
  } catch (const DatabaseError&) {  // nothing was written
  }
}

bool SweepRows::next(SweepRow& row) {
  if (!points_.step()) return false;
  row.id = points_.integer(0);
  row.verdict = points_.text(2);
  row.error = points_.text(3);
  readParameters(row);
  row.values.clear();
  std::size_t guess = 0;
  for (; has_result_ && results_.integer(0) <= row.id; has_result_ = results_.step()) {
    if (results_.integer(0) < row.id) continue;  // a result without a point
    const std::size_t name = indexOf(results_.text(1), guess);
    row.values.push_back({name, results_.real(2), results_.real(3), results_.text(4)});
    guess = name + 1;
  }
  return true;
}

void SweepRows::readParameters(SweepRow& row) const {
  using Json = nlohmann::json;
  const Json all = Json::parse(points_.text(1), nullptr, false);
  if (!all.is_object())
    throw DatabaseError(
        fmt::format("{}: error: the parameters of point {} are not a JSON object: the database is damaged",
                    database_.file().string(), row.id));
  row.parameters.clear();
  for (const std::string& key : keys_) {
    const auto at = all.find(key);
    if (at == all.end() || !at->is_number())
      throw DatabaseError(fmt::format("{}: error: point {} has no number for {}: the database is damaged",
                                      database_.file().string(), row.id, key));
    row.parameters.push_back(at->get<double>());
  }
}

std::size_t SweepRows::indexOf(const std::string& name, std::size_t guess) const {
  return guess < names_.size() && names_[guess] == name ? guess : places_.at(name);
}

}  // namespace ursula
