#include "parts/sweep/report/sweep_rows.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/csv.h"
#include "base/text.h"
#include "parts/sweep/report/sweep_outputs.h"
#include "parts/sweep/sweep_database.h"

namespace ursula {
ColumnStore::ColumnStore(std::size_t columns, std::size_t in_memory)
    : in_memory_(in_memory), width_(columns), columns_(columns) {}

void ColumnStore::addRow(const std::vector<double>& row) {
  if (row.size() != width_ || columns_.size() != width_) throw std::logic_error("a row of another width");
  ++rows_;
  for (std::size_t k = 0; k < row.size(); ++k) columns_[k].recent.push_back(row[k]);
  count(row.size());
}

std::size_t ColumnStore::addColumn(const std::vector<double>& values) {
  if (values.size() != rows_) throw std::logic_error("a column of another length");
  columns_.push_back({values, {}});
  count(values.size());
  return columns_.size() - 1;
}

std::vector<double> ColumnStore::column(std::size_t which) const {
  std::vector<double> out;
  out.reserve(rows_);
  for (const auto& [place, count] : columns_.at(which).earlier) {
    const std::size_t from = out.size();
    out.resize(from + count);
    if (fseeko(file_.get(), place, SEEK_SET) != 0 ||
        std::fread(&out[from], sizeof(double), count, file_.get()) != count)
      throw std::runtime_error("error: a temporary file cannot be read");
  }
  out.insert(out.end(), columns_[which].recent.begin(), columns_[which].recent.end());
  return out;
}

/// Counts new numbers. Moves all to the file if they are too many.
void ColumnStore::count(std::size_t numbers) {
  constexpr std::size_t fewest = 4096;  // of each column at once
  recent_ += numbers;
  if (recent_ <= std::max(in_memory_, fewest * width_)) return;
  if (file_ == nullptr) file_.reset(std::tmpfile());
  for (auto& [recent, earlier] : columns_) {
    if (recent.empty()) continue;
    if (file_ == nullptr || fseeko(file_.get(), 0, SEEK_END) != 0 ||
        std::fwrite(recent.data(), sizeof(double), recent.size(), file_.get()) != recent.size())
      throw std::runtime_error("error: a temporary file cannot be written: is the disk full?");
    earlier.emplace_back(ftello(file_.get()) - static_cast<std::int64_t>(recent.size() * sizeof(double)),
                         recent.size());
    recent.clear();
  }
  recent_ = 0;
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

/// Begins a read transaction, which ends with the last copy.
std::shared_ptr<Sqlite> begun(Sqlite& database) {
  database.run("BEGIN");
  return {&database, [](Sqlite* each) {
            try {
              each->run("COMMIT");
            } catch (const DatabaseError&) {  // nothing was written
            }
          }};
}

}  // namespace

SweepRows::SweepRows(Sqlite& database, const std::vector<std::string>& keys)
    : keys_(keys),
      snapshot_(begun(database)),
      names_(namesIn(database)),
      points_(database, "SELECT id, parameters, verdict, error FROM point ORDER BY id"),
      results_(database, "SELECT point, name, value, \"limit\", verdict FROM result ORDER BY point, name"),
      has_result_(results_.step()) {}

bool SweepRows::next(SweepRow& row) {
  if (!points_.step()) return false;
  row.id = points_.integer(0);
  row.verdict = points_.text(2);
  row.error = points_.text(3);
  readParameters(row);
  row.values.clear();
  for (; has_result_ && results_.integer(0) <= row.id; has_result_ = results_.step()) {
    if (results_.integer(0) < row.id) continue;  // a result without a point
    row.values.push_back({indexOf(results_.text(1)), results_.real(2), results_.real(3), results_.text(4)});
  }
  return true;
}

void SweepRows::readParameters(SweepRow& row) const {
  using Json = nlohmann::json;
  const Json all = Json::parse(points_.text(1), nullptr, false);
  if (!all.is_object())
    throw DatabaseError(
        fmt::format("{}: error: the parameters of point {} are not a JSON object: the database is damaged",
                    snapshot_->file().string(), row.id));
  row.parameters.clear();
  for (const std::string& key : keys_) {
    const auto at = all.find(key);
    if (at == all.end() || !at->is_number())
      throw DatabaseError(fmt::format("{}: error: point {} has no number for {}: the database is damaged",
                                      snapshot_->file().string(), row.id, key));
    row.parameters.push_back(at->get<double>());
  }
}

std::size_t SweepRows::indexOf(const std::string& name) const {
  return std::lower_bound(names_.begin(), names_.end(), name) - names_.begin();
}

namespace {

constexpr std::size_t piece = 1 << 16;  // approximate size of the sink's pieces

void addNumber(double value, std::string& out) {
  if (std::isnan(value)) return;
  fmt::format_to(std::back_inserter(out), "{}", value);
}

std::string header(const std::vector<std::string>& keys, const std::vector<std::string>& names, bool checks) {
  std::string out = "id,verdict";
  const auto add = [&out](const std::string& name) {
    out += ',';
    appendCsvCell(name, out);
  };
  for (const std::string& key : keys) add(key);
  for (const std::string& name : names) {
    add(name);
    if (checks) add(name + ".limit"), add(name + ".verdict");
  }
  return out + ",error\n";
}

void addRow(const SweepRow& row, std::size_t names, bool checks, std::string& out) {
  out += std::to_string(row.id) + ',';
  appendCsvCell(row.verdict, out);
  for (const double parameter : row.parameters) {
    out += ',';
    addNumber(parameter, out);
  }
  auto value = row.values.begin();
  for (std::size_t k = 0; k < names; ++k) {
    out += ',';
    const bool has = value != row.values.end() && value->name == k;
    if (has) addNumber(value->value, out);
    if (checks) out += ',';
    if (checks && has) addNumber(value->limit, out);
    if (checks) out += ',';
    if (checks && has) appendCsvCell(value->verdict, out);
    if (has) ++value;
  }
  out += ',';
  appendCsvCell(row.error, out);
  out += '\n';
}

}  // namespace

void writeSweepCsv(Sqlite& database, const std::function<void(std::string_view)>& sink) {
  const SweepIdentity identity = readIdentity(database);
  const bool checks = identity.what == "validate";
  SweepRows rows(database, identity.keys);
  std::string out = header(identity.keys, rows.names(), checks);
  for (SweepRow row; rows.next(row);) {
    addRow(row, rows.names().size(), checks, out);
    if (out.size() < piece) continue;
    sink(out);
    out.clear();
  }
  sink(out);
}

}  // namespace ursula
