#include "studies/sweep_report/sweep_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/shown_text.h"
#include "studies/sweep/sweep_database.h"

namespace ursula {
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
