#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/csv.h"
#include "studies/sweep/sweep_database.h"
#include "studies/sweep_report/sweep_outputs.h"
#include "studies/sweep_report/sweep_rows.h"

namespace ursula {
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

namespace {

constexpr std::size_t most_errors = 3;

bool isError(const WorstPoint& point) { return point.verdict == "error"; }

bool isWorse(const WorstPoint& a, const WorstPoint& b) {
  const auto failed = [](const WorstPoint& p) { return p.verdict == "fail"; };
  const auto score = [](const WorstPoint& p) {
    return std::isnan(p.score) ? -std::numeric_limits<double>::infinity() : p.score;
  };
  if (failed(a) != failed(b)) return failed(a);
  if (score(a) != score(b)) return score(a) > score(b);
  return a.id < b.id;
}

}  // namespace

bool WorstPoints::takes(const WorstPoint& point) const {
  if (!isError(point)) return others_.size() < most_worst || isWorse(point, others_.back());
  return errors_.size() < most_errors && std::none_of(errors_.begin(), errors_.end(), [&point](const WorstPoint& each) {
           return each.error == point.error;
         });
}

void WorstPoints::add(WorstPoint point) {
  if (!takes(point)) return;
  if (isError(point)) {
    errors_.push_back(std::move(point));
    return;
  }
  others_.insert(std::upper_bound(others_.begin(), others_.end(), point, isWorse), std::move(point));
  if (others_.size() > most_worst) others_.pop_back();
}

std::vector<WorstPoint> WorstPoints::worst() const {
  std::vector<WorstPoint> out = errors_;
  out.insert(out.end(), others_.begin(), others_.end());
  if (out.size() > most_worst) out.resize(most_worst);
  return out;
}

}  // namespace ursula
