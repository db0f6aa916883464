#include "studies/sweep_report/sweep_outputs.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "base/csv_rows.h"
#include "studies/sweep/sweep_database.h"
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

}  // namespace ursula
